"""Effects of a size that no such drive has are not simulated; those that one has are, however weak the input."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rwn
from command_line import MODEL, Run
from made_up_motor import MOTOR as MADE_UP
from rwn.errors import InputError
from rwn.model.vocabulary import Effect, Parameter, table
from rwn.simulate.declared import check_declared, surely_passes
from rwn.simulate.recorded_run import run_of
from rwn.simulate.scales import scales_of_input, usual_scales
from rwn.simulate.simulator import Simulator

MOTOR = rwn.Model(kind="dc", parameters=MADE_UP)
AXIS = rwn.Model(kind="axis", linear=True, parameters={"inertia": 95.0, "viscous_friction": 200.0})
SERVO = rwn.Model(kind="axis", parameters={"inertia": 1e-4, "viscous_friction": 1e-4})
SPRING = {"stiffness": 20.0, "damping": 1e-3, "load_inertia": 1e-4, "load_viscous_share": 0.5}
LTI = rwn.Model(kind="lti", order=1, parameters={"b0": 300.0, "a0": 40.0})


def _simulated(model: rwn.Model, peak: float, *, step: float = 1e-3) -> rwn.Simulation:
    time = step * np.arange(300)
    given = peak * np.sin(np.arange(300) / 30.0)
    run = rwn.Recording(name="run", time=time, signals={model.drive.input: given}, linear=model.linear)
    return rwn.simulate(model, run)


@pytest.mark.parametrize("peak", [0.0, 6.0])
@pytest.mark.parametrize(
    ("model", "effect", "values"),
    [
        (MOTOR, "constant-load", {"torque": 1e9}),
        (MOTOR, "constant-load", {"torque": -1e9}),
        (MOTOR, "coulomb-friction", {"coulomb_torque": 1e4}),
        (MOTOR, "viscous-friction", {"damping": 1e12}),
        (MOTOR, "cogging-torque", {"amplitude": 1e9, "periods_per_rev": 14.0, "phase": 0.0}),
        (MOTOR, "brush-voltage-drop", {"voltage_drop": 1e6, "transition_current": 0.1}),
        (AXIS, "constant-load", {"torque": 1e9}),
        (SERVO, "constant-load", {"torque": 1e9}),
        (LTI, "voltage-saturation", {"limit": 1e6}),
    ],
)  # fmt: skip
def test_a_size_that_no_such_drive_has_is_refused(
    model: rwn.Model, effect: str, values: dict[str, float], peak: float
) -> None:
    name = next(iter(values))
    said = rf"\[effects.{effect}\]: {name} is .*; expected .* under this input or .*; fix: "
    with pytest.raises(InputError, match=said):
        _simulated(replace(model, effects={effect: values}), peak)


@pytest.mark.parametrize("peak", [0.0, 1e-3, 6.0, 400.0])
@pytest.mark.parametrize("step", [1e-6, 1e-3, 1.0])
@pytest.mark.parametrize(
    ("model", "effects"),
    [
        (MOTOR, {"coulomb-friction": {"coulomb_torque": 0.05}, "constant-load": {"torque": -1.0}}),
        (MOTOR, {"load-disturbance": {"torque": 0.1, "t_start": 50.0, "t_end": 60.0}}),
        (MOTOR, {"shaft-compliance": SPRING}),
        (MOTOR, {"slew-rate-limit": {"rate": 10.0}}),
        (AXIS, {"coulomb-friction": {"coulomb_torque": 20.0}}),
        (SERVO, {"coulomb-friction": {"coulomb_torque": 0.02}}),
        (LTI, {"actuator-deadzone": {"deadzone": 0.5}}),
    ],
)  # fmt: skip
def test_a_weak_or_brief_input_does_not_refuse_what_the_drive_has(
    model: rwn.Model, effects: dict[str, dict[str, float]], peak: float, step: float
) -> None:
    assert _simulated(replace(model, effects=effects), peak, step=step).status == "ok"


BOUNDED = [
    (effect, p)
    for effect in table().values()
    for p in effect.parameters
    if p.scale.powers and not (p.cyclic or p.natural or p.idealised)
]


@pytest.mark.parametrize(("effect", "parameter"), BOUNDED, ids=lambda one: one.name)
def test_no_parameter_of_the_table_may_lie_a_slip_of_a_unit_beyond_its_bound(
    effect: Effect, parameter: Parameter
) -> None:
    """A thousandfold, of what the drive shows at 6 V in 5 s: there rows every ms measure all quantities."""
    time = 1e-3 * np.arange(5000)
    given = 6.0 * np.sign(np.sin(3.0 * time))
    run = rwn.Recording(name="run", time=time, signals={"voltage": given})
    (measured,) = scales_of_input([run_of(run, MOTOR)], MOTOR.drive, Simulator.of(MOTOR), MOTOR.vector)
    unit = {p.name: p.scale.of(measured) if p.scale.powers else 1.0 for p in effect.parameters}
    values = {p.name: max(p.lower, 0.3 * p.upper) * unit[p.name] for p in effect.parameters}
    values |= {p.name: 0.1 * values[p.name] for p in effect.instants[:1]}
    rwn.simulate(replace(MOTOR, effects={effect.name: values}), run)
    slipped = values | {parameter.name: 1000.0 * parameter.upper * unit[parameter.name]}
    with pytest.raises(InputError, match=rf"\[effects.{effect.name}\]: ({parameter.name} is |.* it never acts)"):
        rwn.simulate(replace(MOTOR, effects={effect.name: slipped}), run)


@pytest.mark.parametrize(("peak", "runs"), [(6.0, 2), (0.0, 4)])  # of a motor at rest nothing is measured
def test_usual_inputs_are_simulated_only_where_that_of_the_run_does_not_settle_it(
    monkeypatch: pytest.MonkeyPatch, peak: float, runs: int
) -> None:
    seen = []
    simulate = Simulator.simulate
    monkeypatch.setattr(Simulator, "simulate", lambda *given: (seen.append(given), simulate(*given))[1])
    _simulated(replace(MOTOR, effects={"coulomb-friction": {"coulomb_torque": 0.05}}), peak)
    assert len(seen) == runs


@pytest.mark.parametrize("torque", [0.05, 40.0, 1e3])
@pytest.mark.parametrize("peak", [0.0, 1e-3, 6.0, 400.0])
def test_what_one_input_settles_a_further_one_does_not_change(peak: float, torque: float) -> None:
    model = replace(MOTOR, effects={"coulomb-friction": {"coulomb_torque": torque}})
    time = 1e-3 * np.arange(300)
    given = rwn.Recording(name="run", time=time, signals={"voltage": peak * np.sin(30.0 * time)})
    run, simulator = run_of(given, model), Simulator.of(model)
    own = scales_of_input([run], model.drive, simulator, model.vector)
    if surely_passes(model, own):
        check_declared(model, own, usual_scales(model.drive, simulator, model.vector))
    if torque == 1e3 and peak < 400.0:
        assert not surely_passes(model, own)


def test_a_linear_drive_that_runs_away_has_diverged() -> None:
    """It is finite, but no file that holds it could be read again."""
    model = replace(LTI, parameters={"b0": 300.0, "a0": -400.0})
    run = _simulated(model, 6.0)
    assert run.status == "diverged"
    assert "1e+15" in run.advice
    assert np.abs(run.signals["speed"]).max() <= 1e15


def test_the_command_line_refuses_it_in_one_line_and_writes_nothing(run: Run, tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text(MODEL + "[effects.constant-load]\ntorque = 1e9\n")
    code, out, said = run("simulate", "model.toml", "--input", "a.csv", "--out", "sim.csv")
    (line,) = said.splitlines()
    assert (code, out) == (2, "")
    assert line.startswith("rwn: model.toml, [effects.constant-load]: torque is 1e+09 N m; expected ")
    assert not (tmp_path / "sim.csv").exists()


def test_the_command_line_ends_with_3_where_it_runs_away(run: Run, tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text('[motor]\nkind = "lti"\nnumerator = [300.0]\ndenominator = [1.0, -400.0]\n')
    code, out, said = run("simulate", "model.toml", "--input", "a.csv", "--out", "sim.csv")
    (line,) = said.splitlines()
    assert (code, out) == (3, "")
    assert line.startswith("rwn: diverged: ")
    assert not (tmp_path / "sim.csv").exists()
