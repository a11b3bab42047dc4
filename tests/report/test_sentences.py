"""The verdict in sentences."""

from __future__ import annotations

from dataclasses import replace

import made_up
from rwn.recording.inspection import Finding
from rwn.report.sentences import sentences


def test_what_differs_from_file_to_file_is_said_after_the_verdict() -> None:
    odd = [Finding(kind="uneven-load", recording=r, signals=(), count=0, words="", quantity="load") for r in "ab"]
    *_, said = sentences(replace(made_up.adequate(), findings=tuple(odd)))
    assert said == "The recordings differ in load: each is fitted with its own, corrected.toml holds the mean."
