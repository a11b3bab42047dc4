"""Recordings that contradict each other."""

from __future__ import annotations

import pytest

from made_up_files import files_of
from ranked import ranked_from
from rwn.faults.uneven_files import uneven_files
from rwn.model.model import Model

MOTOR = {
    "resistance": 1.0, "inductance": 1e-3, "torque_constant": 0.05, "back_emf_constant": 0.05, "inertia": 2e-5,
    "viscous_friction": 4e-5,
}  # fmt: skip
UNCERTAIN = ("inertia", "resistance", "viscous_friction")
MODEL = Model(kind="dc", parameters=MOTOR, uncertainty=dict.fromkeys(UNCERTAIN, 0.1))


def _said(quantity: str, factors: tuple[float, ...]) -> dict[str, str]:
    """What is said of recordings in which a parameter is so many times as large, by the name of the recording."""
    made = files_of(MODEL, [quantity], factors)
    ranking = ranked_from(made, MODEL, ["coulomb-friction"], at_once=1)
    return {f.recording: f.words for f in uneven_files(ranking) if f.kind == "files-disagree"}


@pytest.mark.parametrize("quantity", ["resistance", "inertia"])
def test_the_parameter_that_files_disagree_on_is_said_by_file(quantity: str) -> None:
    said = _said(quantity, (0.9, 1.0, 1.12))
    assert {"run_0", "run_2"} <= set(said)
    assert said["run_0"].startswith(f"its {quantity} is -")
    assert said["run_2"].startswith(f"its {quantity} is +")


def test_files_of_one_machine_do_not_disagree() -> None:
    assert not _said("resistance", (1.0, 1.0, 1.0))
