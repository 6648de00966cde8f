# Needs make and Python 3.11 only; everything else goes into .venv.
PYTHON ?= python3.11
BIN := .venv/bin
# The overview comes last: it looks for the figures that the others save.
OVERVIEW := notebooks/00-overview.ipynb
NOTEBOOKS = $(sort $(filter-out $(OVERVIEW) %.nbconvert.ipynb,$(wildcard notebooks/*.ipynb))) $(OVERVIEW)
# What a new version of a package underneath may break: models, solvers, drawings, the command line.
LOWEST = $(addprefix tests/, formulations backends branch_and_bound exact/test_optimum.py exact/test_windows.py \
	experiments/summaries figures/test_drawings.py test_flow.py test_generate.py test_graph.py test_imports.py \
	test_instance.py test_look.py test_main.py test_plain_model.py test_relaxation.py test_solve.py test_timing.py)
# No time stamps in the saved file: the same results give the same bytes.
# Kernels talk through sockets in a folder: a TCP port may be taken, and each kernel would warn of it.
RUN_NOTEBOOK = $(BIN)/jupyter nbconvert --to notebook --execute --inplace --log-level=WARN \
	--KernelManager.transport=ipc --KernelManager.ip=$$sockets/kernel \
	--ExecutePreprocessor.record_timing=False \
	--NotebookExporter.preprocessors=nbconvert.preprocessors.CoalesceStreamsPreprocessor
# Two test processes share two cores: each keeps to one thread.
export OMP_NUM_THREADS ?= 1

.PHONY: help venv reproduce test test-all lint lowest notebooks html slides handouts benchmarks lab

help:
	@echo "make reproduce   set up, solve an instance, run the notebooks, rebuild every figure"
	@echo "make test        set up and run the tests (test-all: the slow ones as well)"
	@echo "make lint        style, names and types: ruff and mypy"
	@echo "make lowest      a small suite with the lowest versions that pyproject.toml allows"
	@echo "make notebooks   run every notebook again, save it and its figures"
	@echo "make html        make the site, which needs no network: site/index.html"
	@echo "make slides      make slides of the notebooks, which need no network: build/slides/index.html"
	@echo "make handouts    make exercise sheets without solutions, to be taken anywhere: build/handouts"
	@echo "make benchmarks  measure again the table in benchmarks/README.md"
	@echo "make lab         open the notebooks in JupyterLab"

venv: .venv/ready

# `ready` is written last, so that an installation that was cut short starts again.
.venv/ready: environment.txt
	@echo "== Installing into .venv (a minute or two) =="
	$(PYTHON) -m venv --clear .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r environment.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	$(BIN)/python -m mamttsp versions --warm-up
	touch $@

reproduce: venv
	@echo "== 1/3 Solving an instance by the paper's recipe: 10 targets, 3 agents, windows of 40 s =="
	@mkdir -p build
	$(BIN)/python -m mamttsp generate --targets 10 --window 40 --agents 3 --seed 7 -o build/instance.json
	$(BIN)/python -m mamttsp solve build/instance.json --time-limit 120 -o build/solution.json
	$(BIN)/python -m mamttsp check build/instance.json build/solution.json
	@echo "== 2/3 Making the experiments' tables and figures from the rows in paper_results/ =="
	$(BIN)/python -m mamttsp tables
	$(BIN)/python -m mamttsp figures
	@echo "== 3/3 Running the notebooks, which draw theirs =="
	@$(MAKE) --no-print-directory notebooks
	@echo "== Done: build/solution.json, notebooks/, figures/ =="

test: venv
	$(BIN)/python -m pytest -n 2 --dist loadgroup

test-all: venv
	$(BIN)/python -m pytest -n 2 --dist loadgroup -m "slow or not slow" --timeout 3600

lint: venv
	$(BIN)/python -m ruff check
	$(BIN)/python -m ruff format --check
	$(BIN)/python -m mypy

# Another version of numba compiles into a folder of its own, or it would throw away what .venv has compiled.
lowest:
	@echo "== Installing the lowest versions that pyproject.toml allows into build/lowest =="
	@mkdir -p build
	$(PYTHON) -m venv --clear build/lowest
	$(PYTHON) .ci/lowest.py > build/lowest.txt
	build/lowest/bin/python -m pip install --quiet --disable-pip-version-check -r build/lowest.txt \
		hypothesis pytest pytest-benchmark pytest-timeout pytest-xdist
	NUMBA_CACHE_DIR=$(CURDIR)/build/lowest/compiled build/lowest/bin/python -m pytest -n 2 -W ignore $(LOWEST)

notebooks: venv
	@set -e; sockets=$$(mktemp -d); trap 'rm -rf "$$sockets"' EXIT; for notebook in $(NOTEBOOKS); do echo "-- $$notebook"; $(RUN_NOTEBOOK) $$notebook; done

html: venv
	$(BIN)/python -m sphinx --quiet --keep-going -d build/doctrees docs site
	@echo "== Done: site/index.html =="

slides: venv
	rm -rf build/slides
	$(BIN)/python docs/slides.py build/slides
	@echo "== Done: build/slides/index.html =="

handouts: venv
	rm -rf build/handouts
	$(BIN)/python -m mamttsp.study.handouts build/handouts
	@echo "== Done: build/handouts/notebooks/exercises =="

benchmarks: venv
	$(BIN)/python -m benchmarks.build_models

lab: venv
	$(BIN)/jupyter lab --LabApp.default_url=/lab/tree/$(OVERVIEW)
