"""By which code, when and on what the diagnoses of a set of trials were made: what timing.json beside each says."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rwn.studies.trials.damaged import reading
from rwn.studies.trials.run import out_of, trial_folders

RESULT, TIMING = "diagnosis.json", "timing.json"
UNKNOWN = "a code that was not written down"


def results_of(folder: Path, folders: Sequence[Path], results: Path | None) -> Path | None:
    """Where the diagnoses of one of several sets are: of several, in a folder for each."""
    return results / folder.name if results is not None and len(folders) > 1 else results


def timing_of(place: Path) -> Mapping[str, Any]:
    """What timing.json beside a diagnosis says; nothing where there is none."""
    timing = place / TIMING
    with reading(timing):
        content: Mapping[str, Any] = json.loads(timing.read_text()) if timing.exists() else {}
    return content


def codes(folder: Path, results: Path | None) -> list[str]:
    """The commits that made the diagnoses of a set; several where they differ."""
    return list(dict.fromkeys(str(each.get("commit", UNKNOWN)) for each in _timings(folder, results)))


def diagnosed_by(folder: Path, results: Path | None) -> list[str]:
    """Commit, date and machine of the diagnoses of a set; several where they differ."""
    said = (
        f"{each['commit']} on {each['date']}, {each['machine']}" if "commit" in each else UNKNOWN
        for each in _timings(folder, results)
    )  # fmt: skip
    return list(dict.fromkeys(said))


def _timings(folder: Path, results: Path | None) -> list[Mapping[str, Any]]:
    """Of every trial that has a diagnosis."""
    places = (out_of(trial, results) for trial in trial_folders(folder))
    return [timing_of(place) for place in places if (place / RESULT).exists()]
