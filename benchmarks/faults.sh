#!/bin/sh
# What a free-running fleet makes of faults, about four minutes: benchmarks/faults.sh [PYTHON]
# Root is needed for the networks (ip netns) and nft for dropped packets; what cannot be done here, the log says.
# Prints, and keeps in benchmarks/faults.log; the exit code is 1 if anything is not as it must be.
cd "$(dirname "$0")/.." || exit 2
python="${1:-.venv/bin/python}"
log=benchmarks/faults.log
code=0
{
    echo "benchmarks/faults.sh, $(date -u +%Y-%m-%d), $(git rev-parse --short HEAD), $(nproc) cores, load $(cut -d' ' -f1-3 /proc/loadavg)"
} > "$log"
for part in sea vehicles; do
    PYTHONPATH="$PWD/src" "$python" benchmarks/faults.py "$part" >> "$log" 2>&1 || code=1
done
cat "$log"
exit $code
