"""Speed of the drive simulation and of the EMPS fit; answers are checked first. Run: python bench/bench_simulate.py

Steps per second on one core, value only and with derivatives by 8 parameters, for the axis model without effects, with
Coulomb friction, and for the dc motor; beside the same axis step in numba where numba is installed.
"""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import rwn
from rwn import _core
from rwn.candidate import Nominal, candidate, fit
from rwn.effects import motor_index, parameter_vector, table
from rwn.prepare import prepare

N = 200_000
STEP = 1e-3
AXIS = {"inertia": 95.0, "viscous_friction": 203.5}
DC = {"resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
      "viscous_friction": 7e-5}  # fmt: skip


def best_of(run: Callable[[], object], repeats: int = 7) -> float:
    """Shortest of some runs [s], after one that does not count."""
    run()
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        run()
        times.append(time.perf_counter() - begin)
    return min(times)


def reference_axis(force: np.ndarray, friction: float) -> np.ndarray:
    """Speed of the axis by the exact solution over each step, in Python; stops and starts at zero crossings."""
    a = np.exp(-AXIS["viscous_friction"] / AXIS["inertia"] * STEP)
    gain = (1.0 - a) / AXIS["viscous_friction"]
    speed, out = 0.0, np.empty(force.size)
    for k, f in enumerate(force):
        out[k] = speed
        direction = np.sign(speed) or (np.sign(f) if abs(f) > friction else 0.0)
        after = a * speed + gain * (f - direction * friction) if direction else 0.0
        speed = after if after * direction > 0.0 or friction == 0.0 else 0.0
    return out


def main() -> None:
    t = STEP * np.arange(N)
    force = 120.0 * np.sin(2.0 * np.pi * 0.8 * t) + 25.0 * np.sin(2.0 * np.pi * 3.1 * t)
    machine = platform.processor() or platform.machine()
    print(f"{machine}, {_core.isa()}, {os.cpu_count()} processors, rwn {rwn.__version__}")
    coulomb = table()["coulomb-friction"]
    plain = parameter_vector(AXIS, {})
    dry = parameter_vector(AXIS, {"coulomb-friction": {"coulomb_torque": 20.4}})
    got = np.array(_core.simulate("axis", t, force, plain, [], [])[2])
    want = reference_axis(force, 0.0)
    error = float(np.max(np.abs(got - want)) / np.max(np.abs(want)))
    assert error < 1e-9, error
    print(f"axis against the reference: {error:.1e} relative")
    by = [motor_index("inertia"), motor_index("viscous_friction"), coulomb.first]
    rows = (
        ("axis, no effects", "axis", plain, [], []),
        ("axis, no effects, 2 derivatives", "axis", plain, [], by[:2]),
        ("axis, Coulomb friction", "axis", dry, [coulomb.index], []),
        ("axis, Coulomb friction, 3 derivatives", "axis", dry, [coulomb.index], by),
        ("dc, no effects", "dc", parameter_vector(DC, {}), [], []),
        ("dc, no effects, 6 derivatives", "dc", parameter_vector(DC, {}), [], list(range(6))),
    )
    for name, kind, vector, active, wanted in rows:
        seconds = best_of(lambda k=kind, v=vector, a=active, w=wanted: _core.simulate(k, t, force * 0.1, v, a, w))  # type: ignore[misc]
        print(f"{name:40s} {1e9 * seconds / N:7.1f} ns/step  {1e-6 * N / seconds:6.1f} M steps/s")
    emps()


def emps() -> None:
    """Free-run fit of Coulomb friction and offset to DATA_EMPS (24 841 samples), from the linear nominal model."""
    shared = Path(os.environ.get("RWN_SHARED", Path(__file__).resolve().parents[2] / "shared"))
    file = shared / "data/nonlinear_benchmarks/EMPS/DATA_EMPS.mat"
    if not file.is_file():
        print("EMPS fit: the recording is not here")
        return
    model = rwn.read_model(Path(rwn.__file__).parent / "demo/emps.toml")
    setup = prepare([rwn.read_recording(file, layout=model.recording)], model)
    nominal = Nominal(motor=setup.nominal.motor, uncertainty=setup.nominal.uncertainty, effects={}, free={})
    this = candidate(nominal, ("coulomb-friction", "constant-load"), setup.scales)
    seconds = best_of(lambda: fit(setup.whole, this), repeats=3)
    found = fit(setup.whole, this)
    rms = 1e3 * setup.whole.noise["position"] * np.sqrt(found.chi2 / setup.whole.targets[0].time.size)
    print(f"EMPS free-run fit: {seconds:.3f} s, {found.iterations} iterations, {found.status.name}, {rms:.2f} mm")


if __name__ == "__main__":
    main()
