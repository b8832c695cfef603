# Two commands on a fresh machine with Python >= 3.11: `make demo` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
MINUTES ?= 60
RELEASE := .release
NEW_ENOUGH = $(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Shoal needs Python 3.11 or newer: make PYTHON=python3.12 ..." >&2; exit 2; }
export PIP_DISABLE_PIP_VERSION_CHECK = 1

.PHONY: demo test test-fast lint bench bench-peers arena soak notebook docs docs-open web licenses dist dist-check clean help

help:
	@echo "make demo      run the paper's scenario: table, figure and record in demo-output/"
	@echo "make test      all tests, the slow ones too"
	@echo "make test-fast without the slow ones"
	@echo "make lint      ruff, mypy, import-linter"
	@echo "make bench     speed of the engine beside its anchor and plain NumPy"
	@echo "make bench-peers the paper's step in NumPy, Mesa, PyTorch, JAX and Warp beside Shoal; installs them into .peers/"
	@echo "make arena     the leaderboard of docs/reference/arena.md anew, about ten minutes"
	@echo "make soak      fleets under a seeded adversary on all cores for MINUTES=60; ends with the seed of the first failure"
	@echo "make notebook  the notebook of the docs anew, as results change"
	@echo "make docs      the docs as a site in site/, with search; installs zensical into .docs/; a warning or a dead link is an error"
	@echo "make docs-open every page of it in a browser without a network (needs chromium); after make web, axe-core looks at it, too"
	@echo "make web       the viewer's page from its sources (needs npm; users do not)"
	@echo "make licenses  the table of THIRD_PARTY.md anew, from what is installed"
	@echo "make dist      sdist and wheel in dist/; BASE=https://.../blob/main makes the links of README absolute"
	@echo "make dist-check installs that wheel alone and runs it, under each Python that is here"
	@echo "make clean     remove the environment and everything made"

# The environment is remade when what it holds changes.
$(VENV)/.installed: pyproject.toml
	@$(NEW_ENOUGH)
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --editable '.[dev]'
	@touch $@

demo: $(VENV)/.installed
	@rm -rf demo-output && mkdir demo-output
	$(BIN)/shoal run oceans2020 --out demo-output/record --figure demo-output/oceans2020.png
	@echo; echo "figure: demo-output/oceans2020.png   record: shoal show demo-output/record"

test: $(VENV)/.installed
	$(BIN)/python -m pytest -n auto --dist loadfile

test-fast: $(VENV)/.installed
	$(BIN)/python -m pytest -n auto --dist loadfile -m 'not slow'

lint: $(VENV)/.installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: $(VENV)/.installed
	$(BIN)/python benchmarks/bench_engine.py
	$(BIN)/python benchmarks/bench_strategies.py

bench-peers: $(VENV)/.installed
	$(BIN)/python benchmarks/bench_peers.py $(if $(ANCHOR),--anchor $(ANCHOR))

arena: $(VENV)/.installed
	$(BIN)/shoal compare --suite arena --out arena-output --markdown docs/reference/arena.md

soak: $(VENV)/.installed
	$(BIN)/python benchmarks/soak.py --minutes $(MINUTES)

notebook: $(VENV)/.installed
	$(BIN)/python -m pip install --quiet nbconvert ipykernel
	$(BIN)/python -m nbconvert --to notebook --execute --inplace --ExecutePreprocessor.record_timing=False docs/tutorials/*.ipynb

# The site has an environment of its own: it reads Shoal's sources, and needs nothing that Shoal needs.
DOCS := .docs
$(DOCS)/.installed: docs/tools/requirements.txt
	$(PYTHON) -m venv $(DOCS)
	$(DOCS)/bin/python -m pip install --quiet --requirement docs/tools/requirements.txt
	@touch $@

docs: $(DOCS)/.installed
	$(DOCS)/bin/python docs/tools/stage_site.py build/site
	$(DOCS)/bin/zensical build --clean --strict
	$(DOCS)/bin/python docs/tools/dead_links.py site

docs-open: docs $(VENV)/.installed
	$(BIN)/python docs/tools/open_site.py site $(if $(wildcard web/node_modules/axe-core),--axe)

web:
	cd web && npm ci --no-audit --no-fund && npm run lint && npm test && npm run build

licenses: $(VENV)/.installed
	$(BIN)/python release/licenses.py

$(RELEASE)/.installed:
	@$(NEW_ENOUGH)
	$(PYTHON) -m venv $(RELEASE)
	$(RELEASE)/bin/python -m pip install --quiet 'build>=1.2' 'twine>=6.1'
	@touch $@

dist: $(RELEASE)/.installed
	@$(RELEASE)/bin/python release/build_dist.py $(if $(BASE),--base '$(BASE)')

dist-check: $(RELEASE)/.installed
	@$(RELEASE)/bin/python release/try_wheel.py

clean:
	rm -rf $(VENV) $(RELEASE) $(DOCS) dist .peers site demo-output arena-output .pytest_cache .mypy_cache .ruff_cache .import_linter_cache
