"""The verdict in sentences."""

from __future__ import annotations

from dataclasses import replace

import made_up
from rwn.recording.inspection import Finding
from rwn.report.sentences import sentences


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
