# make demo | demo-real | test | test-slow | check | test-sanitize | test-browser | mutants | lint | bench | stubs | docs; everything else is set up by these.
PY := .venv/bin/python
export PATH := $(CURDIR)/.venv/bin:$(PATH)
JOBS ?= $(shell nproc)
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)
# Tests run side by side already: the threads of a BLAS beside them wait for one another, which multiplies the time.
export OPENBLAS_NUM_THREADS ?= 1
# Where this is set, each of the many processes that tests start compiles NumPy and SciPy anew.
export PYTHONDONTWRITEBYTECODE :=
PIP := $(PY) -m pip install -q --disable-pip-version-check

.PHONY: demo demo-real test check check-python test-cpp test-sanitize test-sanitize-lint test-python test-slow test-browser mutants lint lint-only bench install \
  install-cmake install-tools install-test stubs docs develop clean

# Installed once; again only where something that goes into it has changed.
SOURCES := $(shell find cpp cmake python CMakeLists.txt pyproject.toml -type f -not -name '*.pyc' -not -name '*.so' 2>/dev/null)
INSTALLED := .venv/.installed
install: $(INSTALLED)

$(INSTALLED): $(SOURCES)
	@./tools/setup.sh
	@echo "install: compiling and installing into .venv; some minutes" >&2
	@$(PIP) .
	@touch $@

# What the C++ tests need, which are built while the rest is downloaded.
install-cmake:
	@./tools/setup.sh test
	@$(PIP) cmake ninja

# Not compiled to bytecode: most of these files nothing imports, and what is imported is compiled then, once.
install-tools: install-cmake
	@$(PIP) --no-compile --group test --group dev

install-test: install-tools
	@$(PIP) --no-compile '.[plot,thesis]' -C cmake.define.RWN_WERROR=ON -C cmake.define.RWN_KERNELS_FOR=this

# The main job on the embedded recording, whose missing effect is known.
demo: install
	@.venv/bin/rwn demo --out demo-out --overwrite

# The same on a real machine: EMPS, started from a linear model. The data are not part of rwn.
RWN_SHARED ?= ../shared
EMPS := $(RWN_SHARED)/data/nonlinear_benchmarks/EMPS
demo-real: install
	@[ -f $(EMPS)/DATA_EMPS.mat ] || { echo "demo-real: $(EMPS)/DATA_EMPS.mat is not here; set RWN_SHARED" >&2; exit 2; }
	@.venv/bin/rwn diagnose $(EMPS)/DATA_EMPS.mat --heldout $(EMPS)/DATA_EMPS_PULSES.mat \
	  --model python/rwn/demo/emps.toml --out demo-out/emps --overwrite

# What CI runs first; `test-slow` has the tests that take more than about a second of one quiet core. The sanitized build goes on beside pip, which waits for downloads much of its time; the linters,
# which read the packages that pip installs, beside pytest.
test:
	@$(MAKE) -j2 --no-print-directory test-sanitize-lint test-python

test-sanitize-lint: test-sanitize install-test
	@$(MAKE) --no-print-directory lint-only

# What to run while working: lint, types, imports, and the tests that are not slow of what changed (tools/changed.py), on the
# checkout as it is, which `make develop` installed. The linters go on beside pytest.
check:
	@diff -rq -x '*.so' -x __pycache__ python/rwn .venv/lib/python3*/site-packages/rwn >/dev/null 2>&1 || \
	  { echo "check: what is installed is not this checkout; run 'make develop' first" >&2; exit 2; }
	@$(MAKE) -j2 --no-print-directory lint-only check-python

check-python:
	$(PY) -m pytest -q -n $(JOBS) --dist worksteal -m "not slow" $$($(PY) tools/changed.py)

# The C++ tests as they are shipped: optimised, with the kernels of this processor.
test-cpp: install-cmake
	cmake --preset release >/dev/null
	cmake --build --preset release -j $(JOBS) -- --quiet
	build/release/rwn_tests --gtest_brief=1

# The C++ tests with the address and undefined-behaviour sanitizers; KERNELS_FOR=every: with the kernels of every instruction set.
KERNELS_FOR ?= any
ISAS_any := baseline
ISAS_every := baseline avx2 avx512
test-sanitize: install-cmake
	cmake --preset sanitize -DRWN_KERNELS_FOR=$(KERNELS_FOR) >/dev/null
	cmake --build --preset sanitize -j $(JOBS) -- --quiet
	for isa in $(ISAS_$(KERNELS_FOR)); do RWN_ISA=$$isa build/sanitize/rwn_tests --gtest_brief=1 || exit 1; done

test-python: install-test
	$(PY) -m pytest -n $(JOBS) --dist worksteal -m "not slow"

test-slow: install-test
	$(PY) -m pytest -n $(JOBS) --dist worksteal -m slow --ignore=tests/report/test_browser.py

# The report in headless Chromium: three widths, dark, on paper, links between its plots, axe-core. Not part of `make test`: a machine
# without Chromium would download it each time.
test-browser: install-test
	@./tools/setup.sh browser
	$(PY) -m pytest -n $(JOBS) --dist worksteal tests/report/test_browser.py

# Alters the network kernels one line at a time and asks whether a C++ test notices; by hand. Run again, it tries the survivors.
mutants: install-test
	$(PY) tools/mutants.py --page docs/mutants.md

# Speed, with the answers checked; writes docs/speed.md.
bench:
	@./tools/setup.sh
	@$(PIP) '.[bench]'
	for bench in simulate structured_network recurrent_network diagnose; do \
	  $(PY) bench/bench_$$bench.py --page docs/speed.md || exit 1; done

lint: install-test
	@$(MAKE) --no-print-directory lint-only

lint-only:
	$(PY) -m ruff check python tests bench tools
	$(PY) -m mypy
	PYTHONPATH=python .venv/bin/lint-imports

clean:
	rm -rf build .venv site

# The type stubs of the extensions; a test fails when they are stale.
stubs: install-test
	rm -rf build/stubs
	for m in rwn._core rwn.studies.trials._plant; do \
	  (cd build && $(PY:%=../%) -m pybind11_stubgen $$m -o stubs --exit-code >/dev/null) || exit 1; done
	sed -i '/^__all__/d' build/stubs/rwn/_core.pyi build/stubs/rwn/studies/trials/_plant.pyi
	cp build/stubs/rwn/_core.pyi python/rwn/_core.pyi
	cp build/stubs/rwn/studies/trials/_plant.pyi python/rwn/studies/trials/_plant.pyi

# The site of docs/, in site/.
docs: install-test
	@$(PIP) --group docs
	NO_MKDOCS_2_WARNING=1 DISABLE_MKDOCS_2_WARNING=true $(PY) -m mkdocs build --strict

# For work on rwn itself: quick rebuilds, no build isolation.
develop: install-tools
	@$(PY) -c 'import scikit_build_core' 2>/dev/null || $(PIP) scikit-build-core pybind11 cmeel-eigen
	@$(PIP) --no-build-isolation '.[plot,thesis]' -C cmake.define.RWN_WERROR=ON -C cmake.define.RWN_KERNELS_FOR=this

# How rwn is tested, as figures; each writes its section of docs/testing.md. By hand: each takes minutes or more.
TRUST := PYTHONPATH=. $(PY) -m tools.trust
COUNT ?= 100
SECONDS ?= 60
TARGET ?= every
PAGE := --page docs/testing.md
.PHONY: coverage coverage-cpp fuzz fuzz-corpus hostile kills soak mutants-python long-csv wheels install-trust
install-trust: install-test  # what is measured is this tree
	@$(PIP) --group trust

# Lines and branches of Python; WHICH='not slow' leaves the long tests out.
WHICH ?= slow or not slow
coverage: install-trust
	@mkdir -p build
	$(PY) -m coverage run -m pytest -q -m "$(WHICH)"
	$(PY) -m coverage combine -q
	$(PY) -m coverage json -q -o build/coverage.json
	$(TRUST).coverage build/coverage.json --which "$(WHICH)" $(PAGE)

# Lines and branches of C++, with the kernels that any processor runs, under the C++ tests and the Python tests of WHICH_CPP;
# needs clang++ and llvm of one version: apt-get install clang-19 llvm-19 (LLVM= for the names without a number).
LLVM ?= -19
WHICH_CPP ?= not slow
COVERED := build/coverage
PROFILES := $(CURDIR)/$(COVERED)/profiles
coverage-cpp: install-trust
	@command -v clang++$(LLVM) >/dev/null || { echo "coverage-cpp: no clang++$(LLVM): apt-get install clang$(LLVM) llvm$(LLVM)" >&2; exit 2; }
	@$(PIP) pybind11 cmeel-eigen
	cmake -G Ninja -B $(COVERED) -DCMAKE_CXX_COMPILER=clang++$(LLVM) -DCMAKE_BUILD_TYPE=Debug -DRWN_KERNELS_FOR=any \
	  -DCMAKE_CXX_FLAGS="-O1 -fprofile-instr-generate -fcoverage-mapping" -DRWN_BUILD_TESTS=ON -DSKBUILD=ON \
	  -DPython_EXECUTABLE=$(CURDIR)/$(PY) -Dpybind11_DIR=$$($(PY) -m pybind11 --cmakedir) >/dev/null
	cmake --build $(COVERED) -j $(JOBS) -- --quiet
	rm -rf $(COVERED)/python $(PROFILES) && cp -r python $(COVERED)/python
	cp $(COVERED)/_core*.so $(COVERED)/python/rwn && cp $(COVERED)/_plant*.so $(COVERED)/python/rwn/studies/trials
	for isa in baseline avx2 avx512; do RWN_ISA=$$isa LLVM_PROFILE_FILE=$(PROFILES)/$$isa $(COVERED)/rwn_tests --gtest_brief=1 || exit 1; done
	LLVM_PROFILE_FILE=$(PROFILES)/python-%p PYTHONPATH=$(CURDIR)/$(COVERED)/python $(PY) -m pytest -q -p no:cacheprovider -m "$(WHICH_CPP)"
	llvm-profdata$(LLVM) merge -sparse $(PROFILES)/* -o $(COVERED)/found.profdata
	llvm-cov$(LLVM) export $(COVERED)/rwn_tests $$(printf -- '-object %s ' $(COVERED)/_*.so) \
	  -instr-profile=$(COVERED)/found.profdata -ignore-filename-regex='cpp/tests|/usr/|site-packages' >$(COVERED)/found.json
	$(TRUST).coverage $(COVERED)/found.json --cpp --which "those of C++, and of Python: $(WHICH_CPP)" $(PAGE)

fuzz: install-trust
	$(TRUST).fuzz $(TARGET) --seconds $(SECONDS) $(PAGE)

# Without guidance and with the same inputs in every run, within what UNTIL leaves of a time (as `date +%s`).
UNTIL ?= inf
fuzz-corpus: SECONDS = 600
fuzz-corpus:
	$(TRUST).fuzz_corpus $(TARGET) --seconds $(SECONDS) --until $(UNTIL) --jobs $(JOBS) $(PAGE)

hostile: install-test
	$(TRUST).hostile --damaged $(COUNT) $(PAGE)

kills: install-test
	$(TRUST).kills --count $(COUNT) $(PAGE)

soak: install-test
	$(TRUST).soak --count $(COUNT) $(PAGE)

mutants-python: install-trust
	$(TRUST).mutants --count $(COUNT) $(PAGE)

long-csv: install-test
	$(TRUST).long_csv --count $(COUNT) $(PAGE)

# Two builds of the wheel, one in another folder, and what they hold and answer; and those of PYTHONS="python3.12 python3.13".
PYTHONS ?=
wheels: install-test install-cmake
	@$(PY) -c 'import scikit_build_core, pybind11' 2>/dev/null || $(PIP) scikit-build-core pybind11 cmeel-eigen
	$(TRUST).wheels $(PYTHONS:%=--python %) $(PAGE)
