"""Two parameters of a model that are one number of a machine."""

from __future__ import annotations

from pathlib import Path

import pytest

import rwn
from made_up_motor import MOTOR, recorded
from rwn.errors import InputError
from rwn.model.files import model_to_fit


@pytest.mark.parametrize(("name", "times"), [("back_emf_constant", 105.0), ("torque_constant", 0.01)])
def test_a_constant_without_its_unit_is_refused(name: str, times: float) -> None:
    model = rwn.Model(kind="dc", parameters={**MOTOR, name: times * MOTOR[name]})
    for use in (model_to_fit, lambda m: rwn.identify([recorded(1, lambda *_: 0.0)], m)):
        with pytest.raises(InputError) as refused:
            use(model)
        said = str(refused.value)
        assert "times apart" in said
        assert "V/krpm" in said


def test_a_thousandth_that_was_left_out_is_asked_for_where_it_was() -> None:
    model = rwn.Model(kind="dc", parameters={**MOTOR, "torque_constant": 950.0 * MOTOR["torque_constant"]})
    with pytest.raises(InputError, match=r'as in torque_constant = "[\d.]+ mN m/A"'):
        model_to_fit(model)


def test_constants_that_differ_by_losses_or_by_the_way_they_are_measured_are_not() -> None:
    for times in (0.6, 1.0, 2.0):
        model = rwn.Model(kind="dc", parameters={**MOTOR, "torque_constant": times * MOTOR["torque_constant"]})
        assert model_to_fit(model) is model


def test_a_command_says_which_file(tmp_path: Path) -> None:
    file = tmp_path / "motor.toml"
    rwn.save(rwn.Model(kind="dc", parameters={**MOTOR, "back_emf_constant": 105.0 * MOTOR["torque_constant"]}), file)
    with pytest.raises(InputError, match=r"motor\.toml"):
        model_to_fit(file)
    assert rwn.read_model(file).parameters  # a simulation runs as it is told
