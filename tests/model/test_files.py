"""What rwn writes, rwn reads."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rwn
from made_up_motor import MOTOR, recorded
from rwn.fit.fit import fit_nominal
from rwn.fit.fitted_model import fitted_model
from rwn.fit.preparation import prepare
from rwn.model.drives import KINDS
from rwn.model.files import read_model, write_model
from rwn.model.model import Model
from rwn.model.vocabulary import Parameter, table

POSITIVE = st.floats(1e-9, 1e6)


def sizes(parameter: Parameter) -> st.SearchStrategy[float]:
    """Values that a parameter can have: within its bounds, of any size where these depend on the recording."""
    if not parameter.scale.powers:
        return st.floats(parameter.scale.factor * parameter.lower, parameter.scale.factor * parameter.upper)
    return st.floats(0.0 if parameter.lower >= 0.0 else -1e6, 1e6)


@st.composite
def models(draw: st.DrawFn) -> Model:
    """A model of any kind with effects of the vocabulary, values anywhere."""
    kind = draw(st.sampled_from([k for k, drive in KINDS.items() if not drive.coefficients]))
    drive = KINDS[kind]
    linear = drive.on_a_line is not None and draw(st.booleans())
    parameters = {p.name: draw(POSITIVE if p.positive else st.just(0.0) | POSITIVE) for p in drive.parameters}
    uncertainty = {n: draw(st.floats(0.001, 1.0)) for n, v in parameters.items() if v != 0.0 and draw(st.booleans())}
    known = [n for n, e in table().items() if not e.second_mass and e.site in drive.sites]
    names = draw(st.lists(st.sampled_from(known), max_size=3, unique=True))
    replaced: set[str] = set()
    effects = {}
    for name in names:
        takes_over = {p.replaces for p in table()[name].parameters if p.replaces}
        if takes_over & replaced:
            continue
        replaced |= takes_over
        effect = table()[name]
        lines = draw(st.sets(st.sampled_from([p.line for p in effect.further]))) if effect.further else ()
        parts = (*effect.parameters, *(p for p in effect.further if p.line in lines))
        effects[name] = {p.name: draw(sizes(p)) for p in parts}
        for first, last in zip(effect.instants[:1], effect.instants[1:], strict=True):
            effects[name][last.name] = effects[name][first.name] + draw(st.floats(0.1, 10.0))
    parameters = {n: v for n, v in parameters.items() if n not in replaced}
    uncertainty = {n: v for n, v in uncertainty.items() if n in parameters}
    return Model(kind=kind, parameters=parameters, uncertainty=uncertainty, effects=effects, linear=linear)


@settings(max_examples=150, deadline=None)
@given(model=models())
def test_a_model_comes_back_as_it_was(model: Model) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.toml"
        write_model(model, path)
        assert read_model(path) == model


def test_a_parameter_that_came_out_as_zero_comes_back(tmp_path: Path) -> None:
    """16 of 73 corrected models could not be read: `viscous_friction is relative to a nominal value of 0`."""
    driving = [recorded(seed, lambda w, _: 2e-4 * w) for seed in range(2)]  # as if friction drove
    sheet = Model(kind="dc", parameters=MOTOR, uncertainty={"viscous_friction": 0.3})
    fitted = fitted_model(fit_nominal(prepare(driving, sheet)), sheet)
    assert fitted.parameters["viscous_friction"] == 0.0
    write_model(fitted, tmp_path / "corrected.toml")
    assert read_model(tmp_path / "corrected.toml") == fitted
    again = rwn.simulate(read_model(tmp_path / "corrected.toml"), driving[0])
    assert np.isfinite(again.signals["speed"]).all()


@pytest.mark.parametrize("given", [0.3, "30 %"])
def test_an_uncertainty_is_a_number_or_a_percentage(given: object, tmp_path: Path) -> None:
    text = '[motor]\nkind = "axis"\ninertia = 1.0\nviscous_friction = 0.1\n[uncertainty]\ninertia = '
    (tmp_path / "model.toml").write_text(text + (f'"{given}"' if isinstance(given, str) else str(given)))
    assert read_model(tmp_path / "model.toml").uncertainty["inertia"] == pytest.approx(0.3)
