"""What is said of a corrected.toml that leaves out all that is stated."""

from __future__ import annotations

from dataclasses import replace

import made_up
from rwn.report.held import holds_no_effect
from rwn.report.next_steps import next_steps
from rwn.report.proof_sentences import before_after, headline
from rwn.report.sentences import verdict_sentence


def test_neither_the_verdict_nor_what_to_do_says_that_it_holds_what_was_found() -> None:
    whole = made_up.found()
    assert not holds_no_effect(whole)
    assert "with the effects that were found" in " ".join(next_steps(whole))
    without = replace(whole, added=(), heldout=tuple(replace(r, corrected=None, gain=None) for r in whole.heldout))
    assert holds_no_effect(without)
    assert "corrected.toml holds the model with the refitted parameters" in " ".join(next_steps(without))
    said = verdict_sentence(without)
    assert " that were not fitted are together simulated better without it: corrected.toml leaves it out. " in said
    row = headline(without)
    assert row is not None
    assert said.endswith(" goes from {}, as given, to {}.".format(*before_after(row))), "the figures of the tile"
    assert said.startswith(verdict_sentence(whole).split(". Adding")[0])


def test_a_recording_that_says_the_contrary_of_the_first_is_named() -> None:
    whole = made_up.found()
    first = next(r for r in whole.heldout if (r.region, r.signal) == ("all", "speed"))
    assert first.corrected is not None
    alike = replace(first, recording="other.csv")
    worse = replace(first, gain=-0.2, gain_interval=(-0.3, -0.1), corrected=1.2 * first.refitted)
    said = f"On other.csv it goes from {' to '.join(before_after(alike))}: these two recordings contradict each other."
    assert said in verdict_sentence(replace(whole, heldout=(worse, alike)))
    assert "contradict each other" not in verdict_sentence(replace(whole, heldout=(first, alike)))
    unsure = replace(first, gain=0.05, gain_interval=(-0.1, 0.2), corrected=0.95 * first.refitted)
    assert "contradict each other" not in verdict_sentence(replace(whole, heldout=(unsure, alike)))
    assert "contradict each other" not in verdict_sentence(replace(whole, heldout=(alike, worse)))


def test_control_characters_of_names_are_escaped_in_words() -> None:
    """As the command line does."""
    whole = made_up.found()
    odd = replace(whole, heldout=tuple(replace(r, recording="a\x1b[31m.csv") for r in whole.heldout))
    assert "\x1b" not in str(odd)
    assert "a\\x1b[31m.csv" in str(odd)
