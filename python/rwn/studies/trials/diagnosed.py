"""Trials with their answers and what was diagnosed of them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from rwn.report.diagnosis import Diagnosis
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.grade import load_answers
from rwn.studies.trials.origins import results_of
from rwn.studies.trials.run import out_of, trial_folders


def diagnosed(
    folders: Sequence[Path], results: Path | None, without: Collection[str] = ()
) -> Iterator[tuple[Mapping[str, Any], Diagnosis, Path]]:
    """The answer and the diagnosis of every trial that has both, and the folder of the diagnosis.

    `without`: names of sets that do not count.
    """
    for folder in (f for f in folders if f.name not in without):
        _, answers = load_answers(folder)
        own = results_of(folder, folders, results)
        for trial in trial_folders(folder):
            found = out_of(trial, own) / "diagnosis.json"
            if trial.name in answers and found.exists():
                with reading(found):
                    diagnosis = Diagnosis.from_json(found.read_bytes())
                yield answers[trial.name], diagnosis, found.parent
