# `make` lists the targets. Each set-up step leaves a stamp file in .venv, so that a second run skips it.

PYTHON ?= python3
VENV := .venv
TORCH := $(VENV)/torch
PY := $(VENV)/bin/python
PACKAGES := $(PY) scripts/packages.py
PYTEST_ARGS ?=
# Processes of pytest. All tests of a file run in one process, so that they share its renderers; tests/conftest.py
# says which files are first.
WORKERS ?= auto
PYTEST = $(PY) -m pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder
DOCKER ?= docker
BENCH_ARGS ?=
CONDA_ARGS ?=
CURVES_ARGS ?=
FUZZ_ARGS ?=
GPU_ARGS ?=
IMAGE_ARGS ?=
NOTEBOOK_ARGS ?=
RELEASE_ARGS ?=
SOAK_ARGS ?=
SANITIZE_ARGS ?=
WHEELS_ARGS ?=

# The list has folders, too, since a removed file changes only its folder.
SOURCES := CMakeLists.txt pyproject.toml docs/conventions.md $(shell find cpp cmake shaders python -not -path '*/__pycache__*' 2>/dev/null)
CXX_FILES = $(shell find cpp \( -name '*.cpp' -o -name '*.hpp' \))

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help demo test test-fast test-build test-browser test-cluster test-interop test-torch test-lowest dev lint format stubs bench curves gpu-check docs gallery notebooks sdist wheel wheels image conda release-check sanitize fuzz soak mutants clean

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' Makefile

demo: $(VENV)/.installed ## set up, build, and render a scene with a mirror ball to out/
	@$(PY) -m cubecam demo --out out

test: $(VENV)/.installed $(VENV)/.deps-test ## set up, build, and run the whole test suite
	@$(PYTEST) --durations=10 $(PYTEST_ARGS)

test-fast: $(VENV)/.installed $(VENV)/.deps-test ## run the tests that take less than a second, without notebooks
	@$(PYTEST) -m "not slow and not build and not browser and not cluster and not torch" tests $(PYTEST_ARGS)

test-build: $(VENV)/.installed $(VENV)/.deps-test ## run all tests that compile C++: warnings as errors, ctest, example, materials
	@PATH="$(abspath $(VENV))/bin:$$PATH"; \
	cmake --preset debug -G Ninja -DPython_EXECUTABLE=$(abspath $(PY)) && cmake --build --preset debug && ctest --preset debug
	@$(PY) -m pytest -m build tests/build $(PYTEST_ARGS)

test-browser: docs $(VENV)/.deps-test $(VENV)/.deps-browser ## drive pages, JupyterLab and the site with Chromium, which apt installs
	@$(PYTHON) scripts/system.py --browser
	@$(PY) -m pytest -m browser tests/browser $(PYTEST_ARGS)

test-cluster: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.deps-cluster $(VENV)/.deps-deploy ## kill workers, schedulers and writers of Dask clusters, and look at what they leave; Python 3.11 or newer
	@$(PY) -m pytest -m cluster tests/cluster $(PYTEST_ARGS)

test-interop: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.deps-browser $(VENV)/.deps-light $(VENV)/.deps-peers $(VENV)/.bpy ## compare with three.js, Babylon.js, ktx-parse, Filament, Blender, moderngl, pygfx, VTK; needs npm and Chromium
	@$(PYTHON) scripts/system.py --browser
	@CUBECAM_BPY_PYTHON=$(abspath $(VENV)/bpy/bin/python) $(PY) -m pytest -m interop tests/interop $(PYTEST_ARGS)

test-torch: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.torch ## train with PyTorch while cubecam draws: docs/howto/train.md; downloads 0.5 GB unless PyTorch is there
	@PYTHONPATH="$(abspath $(TORCH))$${PYTHONPATH:+:$$PYTHONPATH}" OMP_WAIT_POLICY=passive $(PY) -m pytest -m torch tests/torch $(PYTEST_ARGS)

test-lowest: $(VENV)/.deps $(VENV)/.deps-lowest ## build and test with the lowest versions that pyproject.toml declares; needs Python 3.10 or 3.11
	@$(PY) scripts/lowest.py $(VENV)/lowest -n $(WORKERS) --dist loadfile --no-loadscope-reorder $(PYTEST_ARGS)

dev: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.deps-dev ## set up for working on cubecam: tests, linters, commit hooks
	@if git rev-parse --git-dir >/dev/null 2>&1; then $(PY) -m pre_commit install; fi

lint: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.deps-dev ## check formatting, types and stubs; change nothing
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	$(VENV)/bin/clang-format --dry-run -Werror $(CXX_FILES)
	$(PY) scripts/stubs.py --check

format: $(VENV)/.deps-dev ## format Python and C++ in place
	$(PY) -m ruff check --fix .
	$(PY) -m ruff format .
	$(VENV)/bin/clang-format -i $(CXX_FILES)

stubs: $(VENV)/.installed $(VENV)/.deps-dev ## write python/cubecam/_core.pyi again from the built module
	$(PY) scripts/stubs.py

bench: $(VENV)/.installed $(VENV)/.deps-bench ## compare with moderngl, ZenGL, py360convert and OpenCV, print ratios
	@$(PY) -m benchmarks $(BENCH_ARGS)

curves: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.deps-bench $(VENV)/.deps-peers ## measure what a cubemap costs beside moderngl, ZenGL, VTK, Panda3D, C++, add to out/curves, write docs/explanation/cost_curves.md
	@$(PY) -m benchmarks.curves --history out/curves --page docs/explanation/cost_curves.md $(CURVES_ARGS)

gpu-check: $(VENV)/.installed $(VENV)/.deps-test $(VENV)/.deps-bench ## try the GPU: tests, benchmarks, readback, 1,000 probes, pictures, one JSON in out/gpu_check
	@$(PY) scripts/gpu_check.py $(GPU_ARGS)

docs: $(VENV)/.installed $(VENV)/.deps-docs $(VENV)/.deps-jupyter ## build the site in docs/_build/html: run its code, check its links
	@$(PY) -m sphinx -b html -W --keep-going -j auto -q -d docs/_build/doctrees docs docs/_build/html
	@$(PY) scripts/check_site.py docs/_build/html

gallery: $(VENV)/.installed $(VENV)/.deps-test ## draw the pictures of the README, docs/howto and docs/explanation into docs/images
	@$(PY) scripts/gallery.py
	@$(PY) scripts/howto.py

notebooks: $(VENV)/.installed $(VENV)/.deps-test ## run the notebooks and write their outputs; NOTEBOOK_ARGS="03 08" chooses
	@$(PY) scripts/notebooks.py $(NOTEBOOK_ARGS)

sdist: $(VENV)/.deps $(VENV)/.deps-packages ## write the source distribution into dist/ and build a wheel from it, with no network
	@$(PY) scripts/sdist.py

wheel: $(VENV)/.deps $(VENV)/.deps-packages ## build a wheel into dist/, check what is in it, and run the demo from it
	@$(PY) scripts/wheel.py

wheels: $(VENV)/.deps $(VENV)/.deps-packages ## build the wheels of a release into dist/ in the images of manylinux_2_28; needs Docker
	@$(PY) -m cibuildwheel --platform linux --output-dir dist $(WHEELS_ARGS)

image: ## build the container image, draw the demo's picture with it to out/image, try its driver; DOCKER=podman
	$(DOCKER) build --tag cubecam $(IMAGE_ARGS) .
	mkdir -p out/image
	$(DOCKER) run --rm --network none --user "$$(id -u):$$(id -g)" --volume "$(CURDIR)/out/image:/out" cubecam
	$(DOCKER) run --rm --network none cubecam doctor --selftest

conda: $(VENV)/.deps $(VENV)/.deps-conda ## build the conda package into dist/conda; CONDA_ARGS="--render" only reads the recipe
	@$(PY) scripts/conda.py $(CONDA_ARGS)

release-check: $(VENV)/.deps $(VENV)/.deps-packages ## check that the tree and dist/ are ready for a release: versions, changelog, tag, packages
	@$(PY) scripts/release.py $(RELEASE_ARGS)

sanitize: $(VENV)/.deps-test ## run the tests with modules for AddressSanitizer and UndefinedBehaviorSanitizer, then for ThreadSanitizer
	@$(PY) scripts/sanitize.py $(SANITIZE_ARGS)

fuzz: $(VENV)/.installed $(VENV)/.deps-test ## try absurd calls, broken pickles, shaders and files; FUZZ_ARGS="--minutes 60 --only api,obj"
	@$(PY) -m tests.fuzz $(FUZZ_ARGS)

soak: $(VENV)/.installed $(VENV)/.deps-test ## edit random worlds, in threads, too, and make many contexts; SOAK_ARGS="--minutes 60"
	@$(PY) -m tests.soak $(SOAK_ARGS)

mutants: $(VENV)/.installed $(VENV)/.deps-test ## break the sources one place at a time: the tests must fail each time
	@$(PY) tests/mutation.py

clean: ## remove everything that make made
	rm -rf .venv build dist out docs/_build docs/gallery docs/lessons docs/project .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks tests/failures
	find cpp python scripts tests benchmarks -name __pycache__ -prune -exec rm -rf {} + 2>/dev/null || true

$(VENV)/.deps: pyproject.toml scripts/system.py scripts/packages.py
	@$(PYTHON) scripts/system.py $(VENV)
	@$(PACKAGES) build run
	@touch $@

$(VENV)/.deps-%: $(VENV)/.deps
	@$(PACKAGES) $*
	@touch $@

# PyTorch for CPUs in a folder of its own: it has none of the libraries for GPUs that pip would bring.
$(VENV)/.torch: $(VENV)/.deps scripts/torch_cpu.py
	@$(PY) scripts/torch_cpu.py $(TORCH)
	@touch $@

# Blender's module needs Python 3.11 and numpy of its own.
$(VENV)/.bpy: $(VENV)/.deps
	@$(PY) -m venv $(VENV)/bpy && $(VENV)/bpy/bin/python -m pip install --quiet "bpy==5.0.1"
	@touch $@

$(VENV)/.installed: $(VENV)/.deps $(SOURCES)
	@$(PACKAGES) --package
	@touch $@
