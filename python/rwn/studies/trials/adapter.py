"""The one place where the trials touch the diagnosing side of rwn: files in, files out."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from rwn.model.model import Model

Array = NDArray[np.float64]

TASK = "task.json"  # in a trial's folder: {"heldout": true} gives the diagnosis the held-out recordings
GAINS = ("speed_gain", "current_gain")  # of the sensors, whose stated uncertainty a task may hold


def task_of(folder: Path) -> Mapping[str, Any]:
    """What a trial states beside its model; nothing without a task."""
    path = folder / TASK
    found: dict[str, Any] = json.loads(path.read_text()) if path.exists() else {}
    return found


def heldout_given(folder: Path) -> bool:
    """Whether the diagnosis may see the held-out recordings; without a task it may not."""
    task = task_of(folder)
    return bool(task and task["heldout"])


def model_of_trial(folder: Path) -> Model:
    """The model of a trial, with the uncertainty of its sensors' scales where the task states one."""
    from rwn.model.files import read_model

    model, stated = read_model(folder / "model.toml"), task_of(folder).get("gain_uncertainty")
    if stated is None:
        return model
    exact = {"sensor-gain": dict.fromkeys(GAINS, 1.0)}
    doubt = {f"sensor-gain.{gain}": float(stated) for gain in GAINS}
    return replace(model, effects={**model.effects, **exact}, uncertainty={**model.uncertainty, **doubt})


def train_files(folder: Path) -> list[Path]:
    return sorted(folder.glob("train_*.csv"))


def heldout_files(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.glob("heldout_*.csv")) if not path.stem.endswith("_clean")]


def simulated_file(out: Path, heldout: Path) -> Path:
    return out / f"{heldout.stem}_simulated.csv"


def refitted_file(out: Path, heldout: Path) -> Path:
    return out / f"{heldout.stem}_refitted.csv"


def write_speed(path: Path, time: Array, speed: Array) -> None:
    np.savetxt(
        path, np.column_stack([time, speed]), fmt="%.9g", delimiter=",", header="time [s],speed [rad/s]", comments=""
    )


def diagnose_trial(folder: Path, out: Path) -> None:
    """Diagnoses the training recordings, then simulates the corrected model on the held-out voltages.

    Writes diagnosis.json, corrected.toml, heldout_*_simulated.csv (time, speed) and timing.json (how long it took; the
    date, the commit, the machine) to `out`, and heldout_*_refitted.csv of the nominal structure refitted where a
    corrected model is offered.
    """
    from rwn.diagnose import diagnose  # heavy, and the score needs only the file names above
    from rwn.faults.late_enable import late_enables, powered
    from rwn.measurement.unrecorded_input import recording_with_inferred_input
    from rwn.model.files import write_model
    from rwn.recording.recording import read_recording
    from rwn.simulate.simulation import simulate
    from rwn.studies.made import made

    out.mkdir(parents=True, exist_ok=True)
    model = model_of_trial(folder)
    begin = time.perf_counter()
    heldout = [read_recording(path) for path in heldout_files(folder)]
    given = heldout if heldout_given(folder) else ()
    found = diagnose([read_recording(path) for path in train_files(folder)], model, heldout=given, jobs=1)
    elapsed = time.perf_counter() - begin
    corrected = found.corrected if found.corrected is not None else model
    write_model(corrected, out / "corrected.toml")
    fitted = {name: row.refitted.value for name, row in found.nominal_fit.parameters.items() if "." not in name}
    for path, shown in zip(heldout_files(folder), heldout, strict=True):
        (began,) = powered([shown], late_enables([shown], corrected), corrected)  # when it began is not the model's
        recording = recording_with_inferred_input(began, corrected)  # nor is what no row shows of its voltage
        write_speed(simulated_file(out, path), recording.time, simulate(corrected, recording).signals["speed"])
        if found.corrected is not None and fitted:
            refitted = simulate(replace(model, parameters={**model.parameters, **fitted}, uncertainty={}), recording)
            write_speed(refitted_file(out, path), recording.time, refitted.signals["speed"])
    timing = {"seconds": round(elapsed, 3), **asdict(made())}
    (out / "timing.json").write_text(json.dumps(timing))
    (out / "diagnosis.json").write_bytes(found.to_json())  # last: its presence says that all is done
