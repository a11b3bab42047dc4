"""The verdict in sentences."""

from __future__ import annotations

from dataclasses import replace

import pytest

import made_up
from rwn.faults.uneven_files import JUDGED_AT_ITS_OWN
from rwn.name.found_effect import FoundEffect
from rwn.recording.inspection import Finding
from rwn.report.sentences import sentences
from rwn.report.text import times_given


def test_what_differs_from_file_to_file_is_said_after_the_verdict() -> None:
    odd = [
        Finding(kind="", recording=r, signals=(), count=0, words="", quantity=quantity, held=held)
        for quantity, held in (("load", "that of c"), ("inertia", "that of c"), ("friction", "the mean"))
        for r in "ab"
    ]
    *_, one, other = sentences(replace(made_up.adequate(), findings=tuple(odd)))
    each = "each is fitted with its own, corrected.toml holds"
    assert one == f"The recordings differ in load and inertia: {each} that of c."
    assert other == f"The recordings differ in friction: {each} the mean."


def test_what_makes_next_to_no_difference_is_said_behind_what_does() -> None:
    """A maker's integrator may be late by half a step, which is there for certain and worth nothing."""
    found = made_up.found()
    (friction,) = found.effects
    delay = FoundEffect(name="input-delay", equation="actuator", probability=0.95)
    (acts,) = [e for e in found.account if e.name == friction.name]
    both = (acts, replace(acts, name="input-delay", probability=0.95, together=0.95, share=1e-7))
    said = sentences(replace(found, effects=(friction, delay), account=both))
    assert said[0] == sentences(found)[0]
    assert "Input delay (probability 95 %) shows too, with less than 0.5 % of the mismatch." in said
    large = (acts, replace(both[1], share=0.2))
    assert "input delay" in sentences(replace(found, effects=(friction, delay), account=large))[0]


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (0.6, "1.2 times its noise at most: it is not much."),
        (5.0, "10 times its noise."),
        (float("inf"), "runs away."),
    ],
)
def test_how_much_is_missing_is_said_where_nothing_is_corrected(error: float, said: str) -> None:
    row = next(r for r in made_up.found().heldout if (r.signal, r.region) == ("speed", "all"))
    left = replace(row, refitted=error, corrected=None, gain=None, gain_interval=None, noise_floor=0.5)
    none = replace(made_up.found(), effects=(), set=(), added=(), stand_in="")
    unknown = replace(none, verdict="unexplained", heldout=(left,))
    *_, last = sentences(unknown)
    assert last.startswith(f"On {left.recording}, not used for fitting, the ")
    assert last.endswith(said)


def test_what_differs_is_said_once_beneath_a_mistake_too() -> None:
    odd = Finding(kind="", recording="a", signals=(), count=0, words="", quantity="load", held="the mean")
    found = made_up.mistake()
    said = sentences(replace(found, findings=(odd,)))
    assert sum("The recordings differ in load" in sentence for sentence in said) == 1


def test_an_error_with_a_number_of_its_own_is_said_to_be_one() -> None:
    """rwn simulate with corrected.toml does not give it."""
    found = made_up.found()
    row = next(r for r in found.heldout if r.region == "all")
    own = Finding(
        kind="files-disagree", recording=row.recording, signals=(), count=0, words="its inertia is +30 % off",
        done=f"{JUDGED_AT_ITS_OWN}; corrected.toml has another",
    )  # fmt: skip
    rows = tuple(replace(r, simulated=40.0 * r.nominal) if r is row else r for r in found.heldout)
    said = sentences(replace(found, heldout=rows, findings=(own,)))
    there = "There its inertia is +30 % off; as rwn simulate runs corrected.toml, without that, it errs by "
    assert any(s.startswith(there) and s.endswith("more than the model as given.") for s in said)
    assert any(f"on {row.recording}, not used for fitting but for numbers of its own," in s for s in said)
    assert not any("rwn simulate runs" in s for s in sentences(replace(found, findings=(own,))))
    alike = tuple(replace(r, simulated=r.corrected) if r is row else r for r in found.heldout)
    assert not any("rwn simulate runs" in s for s in sentences(replace(found, heldout=alike, findings=(own,))))


def test_what_is_off_by_a_power_of_ten_may_be_in_another_unit() -> None:
    assert times_given(1.1e-3, declared=0.1) == "0.0011 times what was given, which may be in another unit"
    assert not any("unit" in times_given(x, declared=0.1) for x in (5.0, 1.05, 0.0))
