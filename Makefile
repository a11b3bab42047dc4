# make demo | demo-real | test | test-sanitize | mutants | lint | bench | stubs; everything else is set up by these.
PY := .venv/bin/python
export PATH := $(CURDIR)/.venv/bin:$(PATH)
JOBS ?= $(shell nproc)
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)

.PHONY: demo demo-real test test-cpp test-sanitize test-python mutants lint bench install install-test stubs develop clean

install:
	@./tools/setup.sh
	@$(PY) -m pip install -q --disable-pip-version-check .

# One build for the extension and the C++ tests: the kernels take most of the time.
WITH_TESTS := -C cmake.define.RWN_BUILD_TESTS=ON -C cmake.define.RWN_WERROR=ON
install-test:
	@./tools/setup.sh test
	@$(PY) -m pip install -q --disable-pip-version-check --group test --group dev '.[thesis]' $(WITH_TESTS)

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

test: test-cpp test-sanitize test-python lint

test-cpp: install-test
	ctest --test-dir "$$(dirname "$$(ls -t build/cp*/rwn_tests | head -n 1)")" --output-on-failure -j $(JOBS)

# The C++ tests with the address and undefined-behaviour sanitizers; EVERY_ISA=ON: with the kernels of every instruction set.
EVERY_ISA ?= OFF
ISAS_OFF := baseline
ISAS_ON := baseline avx2 avx512
test-sanitize: install-test
	cmake -S . -B build/sanitize -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" -DRWN_SANITIZE=ON -DRWN_BUILD_TESTS=ON -DRWN_EVERY_ISA=$(EVERY_ISA) >/dev/null
	cmake --build build/sanitize -j $(JOBS)
	for isa in $(ISAS_$(EVERY_ISA)); do RWN_ISA=$$isa build/sanitize/rwn_tests --gtest_brief=1 || exit 1; done

test-python: install-test
	$(PY) -m pytest -n $(JOBS) --dist worksteal

# Alters the network kernels one line at a time and asks whether a test notices; by hand, it takes an hour.
mutants: install-test
	$(PY) tools/mutants.py

bench:
	@./tools/setup.sh
	@$(PY) -m pip install -q --disable-pip-version-check '.[bench]'
	$(PY) bench/bench_simulate.py
	$(PY) bench/bench_structured_network.py
	$(PY) bench/bench_recurrent_network.py
	$(PY) bench/bench_diagnose.py

lint: install-test
	$(PY) -m ruff check python tests bench
	$(PY) -m mypy

clean:
	rm -rf build .venv

# The type stubs of the extension; a test fails when they are stale.
stubs: install-test
	cd build && $(PY:%=../%) -m pybind11_stubgen rwn._core -o stubs --exit-code >/dev/null && \
	  sed -i '/^__all__/d' stubs/rwn/_core.pyi && cp stubs/rwn/_core.pyi ../python/rwn/_core.pyi

# For work on rwn itself: quick rebuilds, no build isolation.
develop:
	@./tools/setup.sh test
	@[ -d .venv/lib/python3.11/site-packages/scikit_build_core ] || $(PY) -m pip install -q --disable-pip-version-check scikit-build-core pybind11 cmeel-eigen --group test --group dev
	@$(PY) -m pip install -q --disable-pip-version-check --no-build-isolation '.[thesis]' $(WITH_TESTS)
