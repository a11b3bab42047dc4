"""The one place where the trials touch the diagnosing side of rwn: files in, files out."""

from __future__ import annotations

import json
import time
from pathlib import Path

import numpy as np


def train_files(folder: Path) -> list[Path]:
    return sorted(folder.glob("train_*.csv"))


def heldout_files(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.glob("heldout_*.csv")) if not path.stem.endswith("_clean")]


def simulated_file(out: Path, heldout: Path) -> Path:
    return out / f"{heldout.stem}_simulated.csv"


def diagnose_trial(folder: Path, out: Path) -> None:
    """Diagnoses the training recordings, then simulates the corrected model on the held-out voltages.

    Writes diagnosis.json, corrected.toml, heldout_*_simulated.csv (time, speed) and timing.json to `out`.
    """
    from rwn.diagnose import diagnose  # heavy, and the score needs only the file names above
    from rwn.model.files import read_model, write_model
    from rwn.recording.recording import read_recording
    from rwn.simulate.simulation import simulate

    out.mkdir(parents=True, exist_ok=True)
    model = read_model(folder / "model.toml")
    begin = time.perf_counter()
    found = diagnose([read_recording(path) for path in train_files(folder)], model, jobs=1)
    elapsed = time.perf_counter() - begin
    corrected = found.corrected if found.corrected is not None else model
    write_model(corrected, out / "corrected.toml")
    for path in heldout_files(folder):
        recording = read_recording(path)
        speed = simulate(corrected, recording).signals["speed"]
        np.savetxt(
            simulated_file(out, path),
            np.column_stack([recording.time, speed]),
            fmt="%.9g",
            delimiter=",",
            header="time [s],speed [rad/s]",
            comments="",
        )
    (out / "timing.json").write_text(json.dumps({"seconds": round(elapsed, 3)}))
    (out / "diagnosis.json").write_bytes(found.to_json())  # last: its presence says that all is done
