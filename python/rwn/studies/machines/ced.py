"""CED: two electric drives on one belt; the pulley's speed sensor does not see the direction."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from rwn.fit.fit import Fit
from rwn.fit.preparation import prepare
from rwn.model.model import Model
from rwn.name.forward import rank
from rwn.recording.recording import Recording
from rwn.simulate.recorded_run import judging_run
from rwn.studies.machines.machine import Error, Machine, Outcome, Say, cut, data_file, error_of, judged, nominal_model

STEP = 0.02  # [s]
TRAINED = 400  # samples; the last 100 are the test
WINDOWS = (10, 4)  # first samples that the state is estimated from
MEASURE = "speed, last 100 samples, initial window {} [ticks/s]"
AMPLITUDES = (
    ("low", "u11", "z11", 0.115, "0.115 (best), 0.103 SysIdentPy"),
    ("high", "u12", "z12", 0.095, "0.074 (best), 0.107 SysIdentPy"),
)


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """Both amplitudes of the uniformly distributed input, with either initial window of the official protocol."""
    return tuple(_amplitude(*record, say) for record in records(folder))


def records(folder: Path) -> list[tuple[Recording, float, str]]:
    """Each amplitude's whole record, the figure to reach and what is published."""
    import scipy.io

    content = scipy.io.loadmat(str(data_file(folder, "DATAUNIF.MAT")))
    found = []
    for name, u, z, wanted, published in AMPLITUDES:
        voltage, speed = (np.ravel(content[key]).astype(float) for key in (u, z))
        time = STEP * np.arange(voltage.size, dtype=np.float64)
        whole = Recording(name=f"{name} amplitude", time=time, signals={"voltage": voltage, "speed": speed})
        found.append((whole, wanted, published))
    return found


def _amplitude(whole: Recording, wanted: float, published: str, say: Say) -> Outcome:
    train, test = cut(whole, 0, TRAINED), cut(whole, TRAINED)
    model = nominal_model("ced")
    outcome = judged(f"CED, {whole.name}", "linear, third order", model, [train], [test], say)
    errors = [_error(outcome, test, WINDOWS[0], wanted, published)]
    few = WINDOWS[1]
    short = judged(f"CED, {whole.name}, window {few}", "", _window(model, few), [train], [test], say)
    errors.append(_error(short, test, few, wanted, published))
    return replace(outcome, errors=tuple(errors), notes=_lasting(model, train, test))


def _lasting(model: Model, train: Recording, test: Recording) -> tuple[str, ...]:
    """What it changes that errors last: on the test, and where three quarters of the fitted samples are fitted."""
    part = 3 * train.time.size // 4
    inner, rest = cut(train, 0, part), cut(train, part)
    cases = [(inner, rest, WINDOWS[0]), *((train, test, window) for window in WINDOWS)]
    return tuple(
        f"fitted to {fitted.time.size} samples, state from {window}: {plain:.4f} on the {judge.time.size} that follow "
        f"where errors count as independent, {final:.4f} where they count as lasting"
        for fitted, judge, window in cases
        for plain, final in [_plain_and_final(_window(model, window), fitted, judge)]
    )


def _plain_and_final(model: Model, fitted: Recording, judge: Recording) -> tuple[float, float]:
    """Error on `judge` of the model with its sensor, plainly fitted and under coloured noise."""
    ranking = rank(
        prepare([fitted], model), progress=lambda *_: None, names=["sensor-rectification"], at_once=1
    )
    named, run = next(r for r in ranking.fits if r.added), judging_run(judge, model)
    problem = ranking.problem.in_free_run()

    def error(fit: Fit) -> float:
        seen = problem.simulate(run, fit.vector, fit.active).signals["speed"]
        return float(np.sqrt(np.mean((run.speed - seen)[run.judged_from :] ** 2)))

    return error(named.fit), error(named.final)


def _window(model: Model, samples: int) -> Model:
    return replace(model, recording=replace(model.recording, initial_samples=samples))


def _error(outcome: Outcome, test: Recording, window: int, wanted: float, published: str) -> Error:
    return error_of(outcome.found, test.name, "speed", MEASURE.format(window), published=published, wanted=wanted)


MACHINE = Machine(name="ced", folder="nonlinear_benchmarks/CED", source="Wigren, M. Schoukens 2017", run=run)
