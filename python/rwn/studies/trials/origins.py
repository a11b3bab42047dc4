"""By which code, when and on what the diagnoses of a set of trials were made: what timing.json beside each says."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rwn.studies.trials.run import out_of, trial_folders
from rwn.studies.trials.said import Timing, timing_of

RESULT = "diagnosis.json"
UNKNOWN = "a code that was not written down"


def results_of(folder: Path, folders: Sequence[Path], results: Path | None) -> Path | None:
    """Where the diagnoses of one of several sets are: of several, in a folder for each."""
    return results / folder.name if results is not None and len(folders) > 1 else results


def codes(folder: Path, results: Path | None) -> list[str]:
    """The commits that made the diagnoses of a set; several where they differ."""
    return list(dict.fromkeys(each.commit or UNKNOWN for each in _timings(folder, results)))


def diagnosed_by(folder: Path, results: Path | None) -> list[str]:
    """Commit, date and machine of the diagnoses of a set; several where they differ."""
    said = (
        f"{each.commit} on {each.date}, {each.machine}" if each.commit else UNKNOWN
        for each in _timings(folder, results)
    )  # fmt: skip
    return list(dict.fromkeys(said))


def _timings(folder: Path, results: Path | None) -> list[Timing]:
    """Of every trial that has a diagnosis."""
    places = (out_of(trial, results) for trial in trial_folders(folder))
    return [timing_of(place) for place in places if (place / RESULT).exists()]
