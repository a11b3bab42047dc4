"""Speed of the drive simulation and of the EMPS fit; answers are checked first. Run: python bench/bench_simulate.py

Steps per second on one core, value only and with derivatives, for the axis model without effects, with Coulomb friction
(once on a signal that only reverses, once on one that lets it stand in between), for the dc motor, and of the normal
equations of a fit with every effect by itself (its parameters beside those of the motor). Beside the rows
with friction stands how often the motion comes to rest. Results go to memory that is already mapped, as in a fit; the
row "fresh memory" shows what the operating system adds the first time. numba, where installed, runs the plain
time-stepping loop that one would write by hand (it stops at the sample, rwn at the instant). The variants take turns
and the shortest of many runs counts, so that their ratios hold on a busy machine too. --page docs/speed.md writes them.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import rwn
from page import Table, asked_for
from rwn import _core
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.preparation import prepare
from rwn.fit.prior import Prior
from rwn.model.vocabulary import motor_index, parameter_vector, table

N = 200_000
STEP = 1e-3
MASS, VISCOUS, COULOMB = 95.0, 203.5, 20.4
AXIS = {"inertia": MASS, "viscous_friction": VISCOUS}
DC = {"resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
      "viscous_friction": 7e-5}  # fmt: skip


Row = tuple[str, float, str, int]  # name, shortest time [s], remark, samples


def best_of_each(runs: Sequence[Callable[[], object]], repeats: int = 25) -> list[float]:
    """Shortest of some runs of each [s], in turns; the last result of each is kept, so that its memory stays mapped."""
    kept, times = [run() for run in runs], [np.inf] * len(runs)
    for _ in range(repeats):
        for k, run in enumerate(runs):
            begin = time.perf_counter()
            kept[k] = run()
            times[k] = min(times[k], time.perf_counter() - begin)
    return times


def stops(speed: np.ndarray) -> float:
    """Times that the motion comes to rest, per 1000 steps."""
    way = np.sign(speed)
    return 1e3 * float(np.count_nonzero((way[:-1] != 0) & (way[1:] != way[:-1]))) / speed.size


def reference_axis(force: np.ndarray, friction: float) -> np.ndarray:
    """Speed of the axis by the exact solution over each step, in Python; stops and starts at zero crossings."""
    a = np.exp(-VISCOUS / MASS * STEP)
    gain = (1.0 - a) / VISCOUS
    speed, out = 0.0, np.empty(force.size)
    for k, f in enumerate(force):
        out[k] = speed
        direction = np.sign(speed)
        if direction == 0.0 and abs(f) > friction:
            direction = np.sign(f)
        after = a * speed + gain * (f - direction * friction) if direction else 0.0
        speed = after if after * direction > 0.0 or friction == 0.0 else 0.0
    return out


def main() -> None:
    bench = asked_for("simulate", __doc__)
    t = np.arange(N, dtype=np.float64) * STEP
    reversing = 120.0 * np.sin(2.0 * np.pi * 0.8 * t) + 25.0 * np.sin(2.0 * np.pi * 3.1 * t)
    resting = 0.3 * reversing
    coulomb = table()["coulomb-friction"]
    plain = parameter_vector(AXIS, {})
    dry = parameter_vector(AXIS, {"coulomb-friction": {"coulomb_torque": COULOMB}})
    dc = parameter_vector(DC, {})
    got = _core.simulate(_core.Task("axis", time=t, input=reversing), plain, [], []).signals["speed"]
    check("axis", got, reference_axis(reversing, 0.0), 1e-9)
    got = _core.simulate(_core.Task("axis", time=t, input=resting), dry, [coulomb.index], []).signals["speed"]
    check("axis, Coulomb friction", got, reference_axis(resting, COULOMB), 2e-2)  # the reference stops at samples
    by = [motor_index("inertia"), motor_index("viscous_friction"), coulomb.first]
    rows: tuple[tuple[str, str, np.ndarray, np.ndarray, list[int], list[int]], ...] = (
        ("axis, no effects", "axis", reversing, plain, [], []),
        ("axis, no effects, 2 derivatives", "axis", reversing, plain, [], by[:2]),
        ("axis, Coulomb friction, reversing", "axis", reversing, dry, [coulomb.index], []),
        ("axis, Coulomb friction, resting", "axis", resting, dry, [coulomb.index], []),
        ("axis, Coulomb friction, 3 derivatives", "axis", reversing, dry, [coulomb.index], by),
        ("dc, no effects", "dc", 0.1 * reversing, dc, [], []),
        ("dc, no effects, 6 derivatives", "dc", 0.1 * reversing, dc, [], list(range(6))),
    )
    begin = time.perf_counter()
    _core.simulate(_core.Task("axis", time=t, input=reversing), plain, [], [])
    fresh = time.perf_counter() - begin
    runs: dict[str, Callable[[], Any]] = {
        name: partial(_core.simulate, _core.Task(kind, time=t, input=force), vector, active, wanted)
        for name, kind, force, vector, active, wanted in rows
    }
    halted = {name: stops(runs[name]().signals["speed"]) for name, *_, active, _ in rows if active}
    halts = {name: f"{per_thousand:.2f} stops per 1000 steps" for name, per_thousand in halted.items()}
    runs |= in_numba(reversing)
    found = [(name, s, halts.get(name, ""), N) for name, s in zip(runs, best_of_each(list(runs.values())), strict=True)]
    found += [("axis, no effects, fresh memory", fresh, "", N), *effects()]
    bench.show(table_of(found), emps())


def table_of(rows: Sequence[Row]) -> Table:
    """Times by step, and in units of the first row."""
    unit = rows[0][1] / rows[0][3]
    cells = [
        (name, f"{1e9 * s / n:.1f}", f"{1e-6 * n / s:.1f}", f"{s / n / unit:.2f} x", remark)
        for name, s, remark, n in rows
    ]
    return Table("Simulation, one core:", ("", "ns a step", "M steps/s", f"of {rows[0][0]}", ""), cells)


def effects() -> list[Row]:
    """Normal equations of the demonstration motor with each effect at its first guess, by all that would be fitted."""
    demo = Path(rwn.__file__).parent / "demo"
    model = rwn.read_model(demo / "model.toml")
    problem = prepare([rwn.read_recording(demo / "train.csv", layout=model.recording)], model)
    samples = sum(r.time.size for r in problem.runs)
    these = {name: hypothesis(problem.prior, (name,), problem.scales) for name in table()}
    times = best_of_each([partial(problem.normal, h.vector, h.active, h.by) for h in these.values()], repeats=5)
    return [
        (f"dc, {name}, {len(h.by)} derivatives", s, "", samples)
        for (name, h), s in zip(these.items(), times, strict=True)
    ]


def check(name: str, got: Sequence[float], want: np.ndarray, limit: float) -> None:
    """Ends the program where `got` is another answer than the reference."""
    error = float(np.max(np.abs(np.asarray(got) - want)) / np.max(np.abs(want)))
    print(f"{name}: {error:.1e} off the reference, relative")
    if not error < limit:
        sys.exit(f"{name} gives another answer than the reference")


def in_numba(force: np.ndarray) -> dict[str, Callable[[], Any]]:
    """The plain loop compiled, by name; none where numba is not installed."""
    try:
        import numba
    except ImportError:
        return {}
    compiled = numba.njit(reference_axis)
    return {
        "numba: axis, no effects": partial(compiled, force, 0.0),
        "numba: axis, Coulomb friction, reversing": partial(compiled, force, COULOMB),
    }


def emps() -> str:
    """Free-run fit of Coulomb friction and offset to DATA_EMPS (24 841 samples), from the linear nominal model."""
    shared = Path(os.environ.get("RWN_SHARED", Path(__file__).resolve().parents[2] / "shared"))
    file = shared / "data/nonlinear_benchmarks/EMPS/DATA_EMPS.mat"
    if not file.is_file():
        return "EMPS fit: the recording is not here"
    model = rwn.read_model(Path(rwn.__file__).parent / "demo/emps.toml")
    problem = prepare([rwn.read_recording(file, layout=model.recording)], model)
    prior = Prior(motor=problem.prior.motor, uncertainty=problem.prior.uncertainty, effects={}, free={})
    this = hypothesis(prior, ("coulomb-friction", "constant-load"), problem.scales)
    free = problem.in_free_run()
    seconds = best_of_each([lambda: fit(free, this)], repeats=3)[0]
    found = fit(free, this).minimum
    rms = 1e3 * free.noise["position"].level * np.sqrt(found.chi2 / free.runs[0].time.size)
    size, ended = free.runs[0].time.size, found.status.name
    return (
        f"Free-run fit of EMPS ({size} samples): {seconds:.3f} s, {found.iterations} iterations, {ended}, {rms:.2f} mm."
    )


if __name__ == "__main__":
    main()
