"""What to do next is the first thing that the verdict leaves to do."""

from __future__ import annotations

from dataclasses import replace

import pytest

import made_up
from made_up_curves import law
from rwn.decide.account import Remainder
from rwn.faults.uneven_files import DISAGREE
from rwn.fit.intervals import Estimate
from rwn.mismatch_map.regions import INSTANTS, Region
from rwn.name.found_effect import FoundEffect
from rwn.recording.inspection import Finding
from rwn.report.diagnosis import Diagnosis
from rwn.report.diagnosis_data import Beneath, Location
from rwn.report.next_steps import next_steps

NEW = {"next_experiment": ""}


def unexplained(**changed: object) -> Diagnosis:
    """Something without a name, with no experiment that is known to tell."""
    return replace(made_up.unexplained(), **{**NEW, **changed})  # type: ignore[arg-type]


DIFFERS = Finding(kind=DISAGREE, recording="b.csv", signals=(), count=0, words="", quantity="inertia")

AT_INSTANTS = Region(coordinate="time", low=0.3, high=2.0, unit="s", share=0.9, samples_share=0.01, name=INSTANTS)

# the diagnosis, the beginning of each sentence in turn
STEPS: dict[str, tuple[Diagnosis, tuple[str, ...]]] = {
    "a law over a signal": (
        unexplained(curves=(law(),)),
        ("It is drawn over speed in", "Nearest names, not stated: unbalance (31 %).", "Record again with more"),
    ),
    "at single instants": (
        unexplained(curves=(), account=(), location=Location(regions=(AT_INSTANTS,))),
        ("Look at the recordings where the error jumps: a logger that loses rows",),
    ),
    "an experiment in its place": (
        unexplained(next_experiment="Turn it by hand.", curves=(), account=()),
        ("Turn it by hand.", "Record again with more"),
    ),
    "nothing near, nowhere in particular": (
        unexplained(curves=(), account=(), location=replace(made_up.unexplained().location, regions=())),
        (),
    ),
    "a network in its place": (
        unexplained(curves=(), account=(), stand_in="a torque over angle"),
        ("Record again", "corrected.toml holds the model with what stands for it: `rwn simulate"),
    ),
    "adequate": (made_up.adequate(), ("corrected.toml holds the model with the refitted parameters", "What these")),
    "adequate, with an experiment": (
        replace(made_up.adequate(), next_experiment="Reverse slowly."),
        ("Reverse slowly.", "corrected.toml", "What these"),
    ),
    "found, without a run of its own": (
        replace(made_up.found(), sources=made_up.SOURCES[:2]),
        ("To tell it from", "corrected.toml holds the model with the effects", "Keep one recording back"),
    ),
    "found, and something that has no name here beside it": (
        replace(made_up.found(), remainder=Remainder(share=0.12, error=3.0, signals=("speed",))),
        ("To tell it from", "For what is left: where you know", "Record again", "corrected.toml"),
    ),
    "too little motion": (
        replace(made_up.adequate(), verdict="insufficient-excitation"),
        ("Record a run that moves both ways",),
    ),
    "recordings of two machines": (
        replace(made_up.adequate(), findings=(DIFFERS, replace(DIFFERS, recording="c.csv", quantity=""))),
        ("b.csv and c.csv and the other recordings are of machines that differ in inertia", "corrected.toml", "What"),
    ),
    "a mistake": (made_up.mistake(), ("Correct the recording, or the columns",)),
    "a mistake that was not undone": (replace(made_up.mistake(), beneath=None), ("Correct the recording",)),
    "a mistake with physics beneath": (
        replace(
            made_up.mistake(), beneath=Beneath(verdict="missing-physics", set=("a", "b")), next_experiment="Brake it."
        ),
        (
            "Correct the recording", "To tell the rivals apart: Brake it.", "What is said beneath the mistake",
            "corrected.toml holds the model with what was found with the mistake undone",
        ),
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", STEPS)
def test_what_to_do_next(case: str) -> None:
    found, begins = STEPS[case]
    said = next_steps(found)
    assert len(said) == len(begins), said
    for sentence, begin in zip(said, begins, strict=True):
        assert sentence.startswith(begin)


def test_a_late_channel_is_undone_by_the_line_that_is_said() -> None:
    shift = Estimate(value=2e-3, unit="s")
    late = FoundEffect(
        name="time-shift", equation="recording", probability=0.9, parameters={"shift": shift},
        signals=("speed", "position"),
    )  # fmt: skip
    turned = FoundEffect(name="wrong-sign", equation="recording", probability=0.9, signals=("current",))
    rpm = replace(turned, name="wrong-unit", parameters={"factor": Estimate(value=8.0, unit="1")}, signals=("speed",))
    steps = next_steps(replace(made_up.mistake(), effects=(late, turned, rpm)))
    assert '`delays.speed = "2 ms"`, `delays.position = "2 ms"`' in steps[0]
    assert "`columns.current = { scale = -1 }`" in steps[1]
    assert "`columns.speed = { scale = 0.125 }`" in steps[2]
