"""Good files of every format that a damaged one is made from: recordings, models, a result, a set of trials."""

from __future__ import annotations

import json
import shutil
import struct
import warnings
from pathlib import Path

import numpy as np

import rwn
from tools.trust.cases import MODEL, OWN

TIME = np.arange(200) * 1e-3
NAMED = {
    "time [s]": TIME, "voltage [V]": 5.0 * np.sin(60.0 * TIME), "speed [rad/s]": 40.0 * np.sin(60.0 * TIME - 0.7),
}  # fmt: skip


def write_recordings(folder: Path) -> None:
    """a.csv and one recording of each format whose library is installed."""
    folder.mkdir(parents=True, exist_ok=True)
    header, columns = ",".join(NAMED), np.column_stack(list(NAMED.values()))
    np.savetxt(folder / "a.csv", columns, fmt="%.6g", delimiter=",", header=header, comments="")
    np.savetxt(folder / "b.csv", columns[::-1] * [-1, 1, 1] + [0.2, 0, 0], fmt="%.6g", delimiter=",", header=header,
               comments="")  # fmt: skip
    (folder / "motor.toml").write_text(MODEL)


def write_formats(folder: Path) -> None:
    """Recordings to damage, two models, and what several libraries write where they are installed."""
    folder.mkdir(parents=True, exist_ok=True)
    write_recordings(folder)
    (folder / "b.csv").unlink()
    (folder / "own.toml").write_text(MODEL + OWN.replace("{}", "tanh(speed / c)", 1))
    np.savez(folder / "x.npz", **NAMED)
    _write_wpilog(folder / "x.wpilog")
    rows = np.column_stack([TIME, NAMED["voltage [V]"], TIME, NAMED["speed [rad/s]"]]).round(6).tolist()
    (folder / "x.json").write_text(json.dumps({"units": "Radians", "slow-forward": rows}))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for write in (_write_mat, _write_parquet, _write_tdms, _write_mcap):
            try:
                write(folder)
            except ImportError:
                continue  # its extra is not installed


def write_results(folder: Path) -> None:
    """A result of rwn diagnose, and a trial with its sealed answer and that result as its diagnosis; some seconds."""
    from rwn.studies.trials.make import make
    from tools.trust.soak import recording

    (folder / "result").mkdir(parents=True)
    (folder / "result" / "motor.toml").write_text(MODEL)
    model = rwn.read_model(folder / "result" / "motor.toml")
    (folder / "result" / "motor.toml").unlink()
    found = rwn.diagnose(recording(model), model, jobs=1)
    found.write(folder / "result")
    (folder / "result" / "report.html").unlink()
    make(7, 1, folder / "trials", jobs=1)
    (trial,) = (path for path in (folder / "trials").iterdir() if path.is_dir())
    shutil.copytree(folder / "result", trial / "out")
    (trial / "out" / "timing.json").write_text('{"seconds": 1.0}')


def _write_wpilog(path: Path) -> None:
    def record(entry: int, at: int, payload: bytes) -> bytes:
        return struct.pack("<BBHQ", 0b1110100, entry, len(payload), at) + payload

    def start(entry: int, name: str, unit: str) -> bytes:
        texts = b"".join(struct.pack("<I", len(text)) + text.encode() for text in (name, "double", unit))
        return record(0, 0, struct.pack("<BI", 0, entry) + texts)

    content = struct.pack("<6sHI", b"WPILOG", 0x0100, 0) + start(1, "voltage", "Volt") + start(2, "speed", "rad/s")
    for t, u, w in zip(*NAMED.values(), strict=True):
        content += record(1, round(1e6 * t), struct.pack("<d", u)) + record(2, round(1e6 * t), struct.pack("<d", w))
    path.write_bytes(content)


def _write_mat(folder: Path) -> None:
    import scipy.io

    scipy.io.savemat(folder / "x.mat", {"log": {"time": TIME, "voltage": TIME, "speed": TIME}})


def _write_parquet(folder: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet

    pa.parquet.write_table(pa.table(NAMED), folder / "x.parquet")


def _write_tdms(folder: Path) -> None:
    import nptdms

    with nptdms.TdmsWriter(folder / "x.tdms") as writer:
        for name, values in NAMED.items():
            writer.write_segment([nptdms.ChannelObject("Bench", name, values)])


def _write_mcap(folder: Path) -> None:
    from mcap.writer import Writer

    with (folder / "x.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start()
        channel = writer.register_channel("m", "json", writer.register_schema("M", "jsonschema", b"{}"))
        for t, u, w in zip(*NAMED.values(), strict=True):
            data = json.dumps({"voltage": u, "speed": w}).encode()
            writer.add_message(channel, round(1e9 * t), data, round(1e9 * t))
        writer.finish()
