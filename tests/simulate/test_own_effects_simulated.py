"""Effects of a user's own, run by the core like those that come with rwn."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from typer.testing import CliRunner

import rwn
from made_up_motor import BRAKE, BRAKED_NOMINAL, MOTOR, eddies, own, recorded
from rwn import _core
from rwn.cli import app
from rwn.errors import InputError
from rwn.fit.fit import fit
from rwn.fit.hypothesis import hypothesis
from rwn.fit.levenberg_marquardt import FitStatus
from rwn.fit.preparation import prepare
from rwn.model.drives.axis import AXIS, LINEAR_AXIS
from rwn.model.files import write_model
from rwn.model.model import Model
from rwn.model.own_effects import OwnEffect, OwnParameter
from rwn.model.vocabulary import motor_index, parameter_vector
from rwn.recording.recording import write_csv

Array = NDArray[np.float64]


def simulated(model: Model, by: dict[str, float], *, step: float = 1e-3) -> dict[str, Array]:
    """Signals and slopes of one chirp run of a model whose single effect is differentiated by the parameters `by`."""
    t = step * np.arange(1500)
    voltage = 12.0 * np.sin(2.0 * np.pi * (0.5 + t) * t) + 0.3
    (name,) = model.effects
    effect = model.effect_table[name]
    vector = parameter_vector(model.parameters, model.effects, model.effect_table)
    cores = [e.core for e in model.own_effects]
    wanted = [effect.at(p) for p in by]
    made = _core.simulate(_core.Task("dc", time=t, input=voltage, own=cores), vector, [effect.index], wanted)
    assert made.status == "ok"
    return made.signals | {f"d {signal}": slopes for signal, slopes in made.slopes.items()}


def both(name: str, effect: OwnEffect, values: dict[str, float]) -> tuple[dict[str, Array], dict[str, Array]]:
    """Runs of a built-in effect and of a formula whose parameters come in the same order."""
    built_in = simulated(Model(kind="dc", parameters=MOTOR, effects={name: values}), values)
    mine = dict(zip((p.name for p in effect.parameters), values.values(), strict=True))
    model = Model(kind="dc", parameters=MOTOR, effects={"mine": mine}, own_effects=(effect,))
    return built_in, simulated(model, mine)


# Exact where the formula acts on constant terms or at the samples; where it is integrated, an own effect chooses its
# own steps, so that both agree to what 1 ms is worth (the slopes to less, being larger near standstill).
@pytest.mark.parametrize(
    ("name", "effect", "values", "near"),
    [
        ("quadratic-drag", own("torque", "-k * speed * abs(speed)", k="N m s^2"), {"drag_coefficient": 1e-5}, 1e-5),
        ("coulomb-friction", own("friction", "tc", tc="N m"), {"coulomb_torque": 0.02}, 1e-12),
        (
            "stribeck-friction",
            own("friction", "tc + (ts - tc) * exp(-(speed / ws)^2)", tc="N m", ts="N m", ws="rad/s"),
            {"coulomb_torque": 0.02, "static_torque": 0.03, "stribeck_speed": 8.0},
            1e-3,
        ),
        (
            "brush-voltage-drop",
            own("drop", "v * tanh(current / i)", v="V", i="A"),
            {"voltage_drop": 0.5, "transition_current": 0.4},
            1e-3,
        ),
        ("cogging-torque", own("torque", "-a * sin(n * position + p)", a="N m", n="1", p="1"),
         {"amplitude": 0.01, "periods_per_rev": 7.0, "phase": 0.4}, 1e-3),
        (
            "actuator-deadzone",
            own("input", "sign(input) * max(abs(input) - d, d - d)", d="V"),
            {"deadzone": 0.5},
            1e-12,
        ),
        (
            "coasting-bridge",
            own("drop", "-s * max(1 - abs(input) / v, 0) * back_emf_constant * speed", s="1", v="V"),
            {"share": 0.7, "supply": 10.0},
            1e-4,
        ),
        (
            "amplifier-gain-curve",
            own("input", "input * (1 + g * (abs(input) / v)^n)", g="1", n="1", v="V"),
            {"gain_change": -0.2, "exponent": 2.5, "reference_command": 12.0},
            1e-12,
        ),
        (
            "sensor-rectification",
            own("speed", "wr * exp(e * log(abs(speed) / wr))", e="1", wr="rad/s"),
            {"exponent": 1.2, "reference_speed": 50.0},
            1e-12,
        ),
    ],
    ids=lambda x: x if isinstance(x, str) else "",
)  # fmt: skip
def test_a_formula_of_a_built_in_effect_runs_as_that_one(
    name: str, effect: OwnEffect, values: dict[str, float], near: float
) -> None:
    built_in, mine = both(name, effect, values)
    for signal, want in built_in.items():
        atol = near * np.max(np.abs(want)) + 1e-300
        np.testing.assert_allclose(mine[signal], want, atol=atol, rtol=0, err_msg=signal)


def test_a_formula_may_read_nominal_parameters_and_passes_their_slopes_on() -> None:
    doubling = own("torque", "-k * viscous_friction * speed", k="1")
    model = Model(kind="dc", parameters=MOTOR, own_effects=(doubling,), effects={"mine": {"k": 1.0}})
    twice = {**MOTOR, "viscous_friction": 2.0 * MOTOR["viscous_friction"]}
    t = 1e-3 * np.arange(800)
    voltage, by = 5.0 * np.sin(9.0 * t), [motor_index("viscous_friction"), motor_index("inertia")]
    effect, cores = model.effect_table["mine"], [doubling.core]
    vector = parameter_vector(model.parameters, model.effects, model.effect_table)
    mine = _core.simulate(_core.Task("dc", time=t, input=voltage, own=cores), vector, [effect.index], by)
    plain = _core.simulate(_core.Task("dc", time=t, input=voltage), parameter_vector(twice, {}), [], by)
    speeds, slopes = ([getattr(run, of)["speed"] for run in (mine, plain)] for of in ("signals", "slopes"))
    np.testing.assert_allclose(*speeds, atol=1e-6 * np.ptp(speeds[1]))
    np.testing.assert_allclose(slopes[0], slopes[1] * [2.0, 1.0], atol=1e-5 * np.ptp(speeds[1]))


def test_models_with_different_formulas_run_side_by_side() -> None:
    models = [
        Model(kind="dc", parameters=MOTOR, effects={"mine": {"k": 0.01}}, own_effects=(own("torque", text, k="N m"),))
        for text in ("k", "-k", "k * sin(position)", "-k * direction") * 4
    ]
    alone = [simulated(model, {"k": 1})["speed"] for model in models]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda m: simulated(m, {"k": 1})["speed"], models))
    for a, b in zip(alone, together, strict=True):
        np.testing.assert_array_equal(a, b)
    assert not np.allclose(alone[0], alone[1])


def test_the_linear_axis_takes_forces() -> None:
    spring = OwnEffect(
        name="spring", term="load", equation="-k * position", drive=LINEAR_AXIS,
        parameters=(OwnParameter(name="k", unit="N/m", lower=0, upper=1e6, start=1, strength=True),),
    )  # fmt: skip
    model = Model(kind="axis", linear=True, parameters={"inertia": 2.0, "viscous_friction": 0.0}, own_effects=(spring,),
                  effects={"spring": {"k": 50.0}})  # fmt: skip
    t = 1e-3 * np.arange(2000)
    run = rwn.Recording(name="step", time=t, signals={"force": np.full(t.size, 3.0)}, linear=True)
    want = 3.0 / 50.0 * (1.0 - np.cos(np.sqrt(50.0 / 2.0) * t))
    np.testing.assert_allclose(rwn.simulate(model, run).signals["position"], want, atol=1e-8)


def test_a_definition_is_checked_for_the_drive_that_it_is_put_into() -> None:
    with pytest.raises(InputError, match="resistance"):
        Model(kind="axis", parameters={"inertia": 1.0, "viscous_friction": 0.1},
              own_effects=(own("torque", "-k * resistance * speed", k="N m s/ohm"),))  # fmt: skip
    model = Model(kind="axis", parameters={"inertia": 1.0, "viscous_friction": 0.1}, own_effects=(BRAKE,))
    assert model.own_effects[0].drive is AXIS


@pytest.mark.parametrize(
    ("effects", "match"),
    [
        ((replace(BRAKE, name="quadratic-drag"),), "there already"),
        ((BRAKE, BRAKE), "there already"),
        (tuple(replace(BRAKE, name=f"brake-{k}") for k in range(7)), "7 own effects"),
    ],
)
def test_effects_that_cannot_be_together_are_refused(effects: tuple[OwnEffect, ...], match: str) -> None:
    with pytest.raises(InputError, match=match):
        replace(BRAKED_NOMINAL, own_effects=effects)


def test_a_constant_with_a_unit_is_not_fitted() -> None:
    known = replace(BRAKE, parameters=(BRAKE.parameters[0], replace(BRAKE.parameters[1], lower=40, upper=40, start=40)))
    model = replace(BRAKED_NOMINAL, own_effects=(known,))
    problem = prepare([recorded(0, eddies, samples=200)], model)
    this = hypothesis(problem.prior, ("eddy-brake",), problem.scales)
    assert [u.name for u in this.unknowns if "." in u.name] == ["eddy-brake.peak"]
    assert this.vector[model.effect_table["eddy-brake"].at("corner")] == 40.0


def test_a_formula_without_a_value_ends_the_run_with_advice(tmp_path: Path) -> None:
    root = own("torque", "-k * sqrt(speed / w)", k="N m", w="rad/s")
    model = replace(BRAKED_NOMINAL, own_effects=(root,), effects={"mine": {"k": 0.01, "w": 1.0}})
    run = recorded(1, eddies)
    done = rwn.simulate(model, run)
    assert done.status == "formula-failed"
    assert "finite" in done.advice
    assert all(np.isfinite(y).all() for y in done.signals.values())
    write_model(model, tmp_path / "model.toml")
    write_csv(tmp_path / "run.csv", run.time, run.signals)
    line = ["simulate", str(tmp_path / "model.toml"), "--input", str(tmp_path / "run.csv"), "--out"]
    said = CliRunner().invoke(app, [*line, str(tmp_path / "sim.csv")])
    assert said.exit_code == 3, "a run that ends with advice is no success"
    assert "formula-failed" in said.output
    problem = prepare([run], replace(model, effects={}))
    end = fit(problem, hypothesis(problem.prior, ("mine",), problem.scales))
    assert end.minimum.status is FitStatus.DIVERGED
    assert end.cost == np.inf


def test_a_gain_that_falls_is_constant_from_where_it_would_turn_back() -> None:
    """v = u (1 - 0.5 (u/4)^2) is steepest at 0 and level at u = 4 sqrt(2/3)."""
    curve = {"gain_change": -0.5, "exponent": 2.0, "reference_command": 4.0}
    level = 4.0 * np.sqrt(2.0 / 3.0)

    def settled(voltage: float, effects: dict[str, dict[str, float]]) -> float:
        run = rwn.Recording(name="step", time=1e-3 * np.arange(900), signals={"voltage": np.full(900, voltage)})
        model = Model(kind="dc", parameters=MOTOR, effects=effects)
        return float(rwn.simulate(model, run).signals["speed"][-1])

    for voltage in (level, 6.0, 12.0):
        assert settled(voltage, {"amplifier-gain-curve": curve}) == pytest.approx(settled(2.0 / 3.0 * level, {}))
