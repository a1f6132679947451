# Everything a person does with this tree, on Debian 12 from nothing but make. `make` alone lists the targets.

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

# demo: a mesh file of yours, and where the results go
MESH ?=
OUT ?= out
# ON: warnings are errors in the release build
WERROR ?= OFF
# check: executions of the header's and the coder's fuzz targets; of the whole file's a tenth. A campaign takes 200000.
FUZZ_RUNS ?= 20000

jobs := $(shell nproc)
venv := .venv/bin
release := build/release
stamp := build/stamps
export PATH := $(CURDIR)/$(venv):$(PATH)
ifneq ($(shell command -v ccache),)
export CMAKE_CXX_COMPILER_LAUNCHER ?= ccache
endif

sources := CMakeLists.txt pyproject.toml $(shell find cmake native python -type f -not -path '*/__pycache__/*')
build_packages := g++ cmake ninja-build libeigen3-dev python3-venv python3-dev
test_packages := libgtest-dev libopenmesh-dev
check_packages := ccache clang clang-format clang-tidy llvm libclang-rt-14-dev \
    g++-aarch64-linux-gnu qemu-user libbenchmark-dev

.PHONY: help demo test check wheel blender bench format clean
help:
	@echo 'make demo [MESH=path]  set up, build, compress an example mesh (or yours), print a table, write the result'
	@echo 'make test              set up, build, run the native, the Python and the Blender tests'
	@echo 'make check             for developers: warnings, formats, linters, sanitizers, fuzzing, determinism'
	@echo 'make check-more        what takes longer than it is worth for every change: analyzer, coverage, more builds'
	@echo 'make wheel             a wheel in dist/, tried in an empty environment'
	@echo 'make blender           the Blender add-on in dist/, a zip for 3.4 and later'
	@echo 'make bench             benchmarks'
	@echo 'make format            clang-format and ruff, in place'
	@echo 'make clean             remove what was built'

# --- set-up ---------------------------------------------------------------------------------------------------

$(stamp)/apt-%: Makefile .ci/need
	@mkdir -p $(stamp)
	.ci/need $($*_packages)
	@touch $@

$(stamp)/venv-build: .ci/requirements/build.txt $(stamp)/apt-build
	python3 -m venv .venv
	$(venv)/python -m pip install --quiet -r $<
	@touch $@

$(stamp)/venv-%: .ci/requirements/%.txt $(stamp)/venv-build
	$(venv)/python -m pip install --quiet -r $<
	@touch $@

# The extension and the native tests share one build tree.
$(stamp)/installed: $(sources) $(stamp)/venv-build
	@echo "Building pfgeom ($(jobs) jobs, a few minutes the first time)"
	$(venv)/python -m pip install --quiet --no-build-isolation --no-deps --force-reinstall \
	    --config-settings=build-dir=$(release) --config-settings=cmake.define.CMAKE_EXPORT_COMPILE_COMMANDS=ON \
	    $(if $(filter ON,$(WERROR)),--config-settings=cmake.define.PFGEOM_WARNINGS_AS_ERRORS=ON) .
	@touch $@

# --- for everybody --------------------------------------------------------------------------------------------

demo: $(stamp)/installed
	@$(venv)/python examples/demo.py $(if $(MESH),"$(MESH)") --out "$(OUT)"

.PHONY: native-tests
native-tests: $(stamp)/installed $(stamp)/apt-test
	cmake -S . -B $(release) -DPFGEOM_BUILD_TESTS=ON >/dev/null
	.ci/step 'build, release' cmake --build $(release) --parallel $(jobs)

test: native-tests $(stamp)/venv-test $(stamp)/blender
	.ci/blender start
	.ci/step 'native tests' ctest --test-dir $(release) --parallel $(jobs) --output-on-failure
	.ci/step 'Python and style tests' $(venv)/python -m pytest -q -n $(jobs)
	.ci/step 'getting Blender' .ci/blender wait
	.ci/step 'Blender tests' $(venv)/python -m pytest -q tests/blender

# Alone, with nothing else.
.PHONY: blender-tests
blender-tests: $(stamp)/venv-test $(stamp)/blender
	.ci/blender start
	.ci/blender wait
	$(venv)/python -m pytest -q tests/blender

# --- for developers -------------------------------------------------------------------------------------------

checks := check-format check-python check-warnings check-sanitizers check-threads check-fuzz check-tidy \
    check-determinism
more_checks := check-analyzer check-coverage check-builds
.PHONY: $(checks) $(more_checks) check-more check-tools
check:
	@for c in $(checks); do .ci/step $$c $(MAKE) --no-print-directory $$c; done
	@echo 'All checks passed.'

check-more:
	@for c in $(more_checks); do .ci/step $$c $(MAKE) --no-print-directory $$c; done

check-tools: $(stamp)/apt-test $(stamp)/apt-check $(stamp)/venv-test $(stamp)/venv-check

cpp_files = $(shell find native tests examples -name '*.h' -o -name '*.cpp')
check-format: check-tools
	clang-format --dry-run -Werror $(cpp_files)

check-python: check-tools $(stamp)/installed
	ruff check .
	ruff format --check .
	mypy

# GCC here; Clang's warnings are errors in the asan preset.
check-warnings: check-tools $(stamp)/installed
	cmake --preset release -DPFGEOM_WARNINGS_AS_ERRORS=ON >/dev/null
	cmake --build $(release) --parallel $(jobs)

# Left out: what takes minutes here and sees no code that the others do not.
too_slow := Simplify.(DoesNotDependOnThreads|RmsIsKept)|Manifold.Noise|Compress.(SmoothFreeForms|EveryEffort|HoldsItsPromiseAtFine)|CompressCopies.(AmongOther|AreOneObject)|MirroredModel.(TakesFewer|CopiesOf|Materials)|MirroredPart.(IsExactly|BothHalves|IsTheSame)|Paint.FunctionsDoNotChange|Sheet.AFreeFormWithHolesTakes|Manifold.*pebble|Manifold.RandomBumps|Simplify.KeepsTheTolerance|CompressCopies.FaceOut|TreeBound.(FindsPlanted|AgreesWithDense)|MirroredModel.(Answers|APlane)|CutHierarchy.TakesFewer|Paint.ABlob|Copies.BytesDoNot|Copies.OnlyWhere|CurvedPart.RoundBorders|Offset.OfRms|Simplify.TheWall
check-sanitizers: check-tools
	cmake --preset asan >/dev/null
	cmake --build build/asan --parallel $(jobs)
	ctest --test-dir build/asan --parallel $(jobs) --output-on-failure -E '$(too_slow)'

# The tests that use threads, and one mesh through the whole pipeline.
check-threads: check-tools
	cmake --preset tsan >/dev/null
	cmake --build build/tsan --parallel $(jobs) --target test_base test_fit test_polygonize test_report \
	    determinism_driver
	TSAN_OPTIONS=halt_on_error=1 ctest --test-dir build/tsan --output-on-failure -L 'base|fit|polygonize|report' \
	    -R 'Parallel|Thread|Cancel|PatchLoop|CollapseAhead' -E '$(too_slow)'
	TSAN_OPTIONS=halt_on_error=1 build/tsan/tests/determinism/determinism_driver 4 pebble

check-fuzz: check-tools
	cmake --preset asan >/dev/null
	cmake --build build/asan --parallel $(jobs)
	.ci/fuzz build/asan $(FUZZ_RUNS)

# The analyzer takes more than half of clang-tidy's time.
check-tidy: check-tools $(stamp)/installed
	.ci/tidy $(release) '-clang-analyzer-*'

check-analyzer: check-tools $(stamp)/installed
	.ci/tidy $(release) '-*,clang-analyzer-*,-clang-analyzer-optin.cplusplus.UninitializedObject'

check-determinism: check-tools
	$(venv)/python tests/determinism/run.py --jobs $(jobs)

check-builds: check-tools
	$(venv)/python tests/determinism/run.py --jobs $(jobs) --all

check-coverage: check-tools
	cmake --preset coverage >/dev/null
	cmake --build build/coverage --parallel $(jobs) --target test_codec
	find build/coverage -name '*.gcda' -delete
	build/coverage/tests/test_codec --gtest_brief=1
	gcovr --root . --filter native/pfgeom/codec/ --fail-under-line 90 build/coverage/CMakeFiles/pfgeom_codec.dir

# Repaired: it holds every library that not every Linux has.
$(stamp)/wheel: $(stamp)/installed $(stamp)/venv-wheel
	rm -rf build/wheel && mkdir -p build/wheel dist
	$(venv)/python -m pip wheel --quiet --no-build-isolation --no-deps --wheel-dir build/wheel \
	    --config-settings=build-dir=$(release) .
	rm -f dist/pfgeom-*-$$($(venv)/python -c 'import sys; print("cp%d%d" % sys.version_info[:2])')-*.whl
	$(venv)/auditwheel repair --wheel-dir dist build/wheel/*.whl
	@touch $@

wheel: $(stamp)/wheel
	rm -rf build/wheel/venv && python3 -m venv build/wheel/venv
	build/wheel/venv/bin/python -m pip install --quiet "$$(ls -t dist/*.whl | head -1)"
	cd build/wheel && venv/bin/python -I ../../tests/install/wheel.py

addon_sources := $(shell find blender_addon -type f -not -path '*/__pycache__/*')
$(stamp)/blender: $(stamp)/wheel $(addon_sources)
	$(venv)/python blender_addon/build.py dist/pfgeom-*.whl --out dist
	@touch $@

blender: $(stamp)/blender

bench: $(stamp)/apt-check $(stamp)/venv-build
	cmake --preset release -DPFGEOM_BUILD_BENCHMARKS=ON >/dev/null
	cmake --build $(release) --parallel $(jobs) --target pfgeom_bench simplify_mesh mesh_part
	$(release)/tests/bench/pfgeom_bench

format: check-tools
	clang-format -i $(cpp_files)
	ruff check --fix-only .
	ruff format .

clean:
	rm -rf build dist out .venv .mypy_cache .pytest_cache .ruff_cache .hypothesis
