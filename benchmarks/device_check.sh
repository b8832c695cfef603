#!/bin/sh
# Runs on a graphics card checked against the processor and timed, on a bare machine: Python with numba, and a driver.
# Wheels that the machine lacks may lie in .whl (its numba-cuda is used if it is 0.30 or newer, else .whl/cuda).
set -e
cd "$(dirname "$0")/.."
site=$(mktemp -d)
pip="python3 -m pip install -q --no-index --no-deps --no-compile --no-cache-dir --upgrade --target $site"
if ls .whl/*.whl >/dev/null 2>&1; then $pip .whl/*.whl; fi
if ls .whl/cuda/*.whl >/dev/null 2>&1 && ! python3 -c '
import numba_cuda, sys
sys.exit(tuple(map(int, numba_cuda.__version__.split(".")[:2])) < (0, 30))' 2>/dev/null; then $pip .whl/cuda/*.whl; fi
export PYTHONPATH="$PWD/src:$site" OPENBLAS_NUM_THREADS=1
nvidia-smi --query-gpu=name,driver_version,clocks.sm,power.limit --format=csv,noheader || true
exec python3 benchmarks/device_check.py "$@"
