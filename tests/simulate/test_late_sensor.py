"""A sensor that shows what was a while before, by any part of a row."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from made_up_motor import SMALL as MOTOR

MODEL = rwn.Model(kind="dc", parameters=MOTOR)
ROW, FINER = 2e-3, 200


def _run(times: int) -> rwn.Recording:
    """Steps of the voltage every 20 ms, in `times` as many rows."""
    voltage = np.repeat(np.random.default_rng(5).uniform(-3.0, 3.0, 40), 10 * times)
    return rwn.Recording(name="run", time=ROW / times * np.arange(voltage.size), signals={"voltage": voltage})


@pytest.mark.parametrize("rows", [0.0, 0.375, 0.88, 1.0, 2.5, 7.9, 137.3, 900.0])
@pytest.mark.parametrize(("effect", "late"), [("current-sensor-delay", ["current"]),
                                              ("speed-sensor-delay", ["speed", "position"])])  # fmt: skip
def test_it_shows_what_finer_rows_had_so_much_sooner(rows: float, effect: str, late: list[str]) -> None:
    shown = rwn.simulate(replace(MODEL, effects={effect: {"delay": rows * ROW}}), _run(1)).signals
    fine = rwn.simulate(MODEL, _run(FINER)).signals
    sooner = np.maximum(np.arange(shown["speed"].size) * FINER - round(rows * FINER), 0)
    for name, values in shown.items():
        true = fine[name][sooner] if name in late else fine[name][::FINER]
        np.testing.assert_allclose(values, true, atol=1e-4 * np.max(np.abs(true)), err_msg=name)


def test_two_are_late_each_by_its_own_time() -> None:
    effects = {"current-sensor-delay": {"delay": 0.7 * ROW}, "speed-sensor-delay": {"delay": 1.6 * ROW}}
    both = rwn.simulate(replace(MODEL, effects=effects), _run(1)).signals
    for effect, name in zip(effects, ("current", "speed"), strict=True):
        alone = rwn.simulate(replace(MODEL, effects={effect: effects[effect]}), _run(1)).signals
        np.testing.assert_allclose(both[name], alone[name], atol=1e-6 * np.max(np.abs(alone[name])))


def test_what_is_late_is_what_the_sensor_filtered() -> None:
    lag, late = {"speed-sensor-lag": {"time_constant": 3e-3}}, {"speed-sensor-delay": {"delay": ROW}}
    filtered = rwn.simulate(replace(MODEL, effects=lag), _run(1)).signals["speed"]
    both = rwn.simulate(replace(MODEL, effects=lag | late), _run(1)).signals["speed"]
    np.testing.assert_allclose(both[1:], filtered[:-1], atol=1e-9)


def test_it_is_found_against_another_channel_alone() -> None:
    """Against the input it is the input that is late."""
    from rwn.fit.preparation import prepare
    from rwn.name.observable import observable

    run = _run(1)
    signals = {**run.signals, **rwn.simulate(MODEL, run).signals}
    for seen, shows in (({"current", "speed"}, True), ({"speed", "position"}, False), ({"current"}, False)):
        problem = prepare([replace(run, signals={n: signals[n] for n in seen | {"voltage"}})], MODEL)
        assert observable("current-sensor-delay", problem) is shows
        assert observable("speed-sensor-delay", problem) is shows
