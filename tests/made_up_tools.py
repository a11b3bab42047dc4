"""Made-up tools that diagnose blind trials; a process that runs one imports this file, so it imports little."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from rwn.studies.trials.adapter import heldout_files, simulated_file
from rwn.studies.trials.grade import clean_speed, load_answers
from rwn.studies.trials.trial_files import read_columns

RESULT = "diagnosis.json"


def tell_the_truth(trial: Path, out: Path) -> None:
    """A diagnosis that has read the answers: every target must be met."""
    answer = load_answers(trial.parent)[1][trial.name]
    effects = [
        {
            "name": effect["name"],
            "equation": effect["equation"],
            "probability": 1.0,
            "parameters": {
                name: p | {"interval": [p["value"] - 1e-9, p["value"] + 1e-9]}
                for name, p in effect["parameters"].items()
            },
        }
        for effect in answer["effects"]
    ]
    named = answer["verdict"] == "missing-physics"
    said = {
        "verdict": answer["verdict"],
        "equation": effects[0]["equation"] if effects else "",
        "effects": effects if named else [],
        "set": [effects[0]["name"]] if named and effects else [],
    }
    for heldout in heldout_files(trial):
        time = read_columns(heldout)["time"]
        table = np.column_stack([time, clean_speed(answer, heldout)])
        np.savetxt(
            simulated_file(out, heldout), table, delimiter=",", header="time [s],speed [rad/s]", comments=""
        )
    (out / RESULT).write_text(json.dumps(said))


def always_backlash(_: Path, out: Path) -> None:
    """A tool that is sure of itself and knows one name."""
    said = {
        "verdict": "missing-physics",
        "equation": "mechanical",
        "effects": [{"name": "backlash", "equation": "mechanical", "probability": 0.9, "parameters": {}}],
        "set": ["backlash"],
    }
    (out / RESULT).write_text(json.dumps(said))


def fails_once(trial: Path, out: Path) -> None:
    """A tool that is killed the first time."""
    mark = trial.parent / f"{trial.name}.tried"
    if not mark.exists():
        mark.touch()
        raise RuntimeError("killed")
    (out / RESULT).write_text('{"verdict": "adequate"}')
