"""File formats of recordings. One file per format and one line in FORMATS; each reads a path into a Table."""

from __future__ import annotations

from collections.abc import Callable, Collection
from pathlib import Path

from rwn.errors import InputError
from rwn.input_file import input_file
from rwn.recording.formats.csv import read_csv
from rwn.recording.formats.excel import read_excel
from rwn.recording.formats.mat import read_mat
from rwn.recording.formats.mcap import read_mcap
from rwn.recording.formats.mdf import read_mdf
from rwn.recording.formats.npz import read_npz
from rwn.recording.formats.parquet import read_parquet
from rwn.recording.formats.part import file_and_part, part_of
from rwn.recording.formats.sysid import read_sysid
from rwn.recording.formats.table import MAX_SAMPLES, Table
from rwn.recording.formats.tdms import read_tdms
from rwn.recording.formats.wpilog import read_wpilog

Reader = Callable[[Path, Collection[str]], Table]

FORMATS: dict[str, Reader] = {
    **dict.fromkeys((".csv", ".txt", ".tsv", ".dat"), read_csv),
    ".mat": read_mat,
    **dict.fromkeys((".npz", ".npy"), read_npz),
    ".parquet": read_parquet,
    **dict.fromkeys((".xlsx", ".xlsm", ".xls", ".ods"), read_excel),
    ".mcap": read_mcap,
    ".wpilog": read_wpilog,
    ".json": read_sysid,
    ".tdms": read_tdms,
    **dict.fromkeys((".mf4", ".mdf"), read_mdf),
}

# What is converted with the tools that wrote it, and how (mcap.dev/guides/getting-started/ros-2).
CONVERTED: dict[str, str] = {
    ".db3": "convert the bag to .mcap: mcap convert {path} {stem}.mcap, or ros2 bag convert -i {path} -o convert.yaml "
    "with storage_id: mcap for its output bag"
}

__all__ = ["FORMATS", "MAX_SAMPLES", "Table", "read_table"]


def read_table(path: Path, wanted: Collection[str]) -> Table:
    """The `wanted` columns of a file, by the format of its ending; `file#part` reads a part. Raises InputError."""
    path, part = file_and_part(path)
    path = _in_bag(path)
    reader = FORMATS.get(path.suffix.lower())
    if reader is None:
        raise _unknown_kind(path)
    with input_file(path, "a recording file"):
        return part_of(reader, path, part, wanted) if part else reader(path, wanted)


def _unknown_kind(path: Path) -> InputError:
    ending = path.suffix.lower()
    if path.is_dir():
        what, fix = "a folder without an .mcap file", "give one of its files"
    elif not ending:
        what, fix = "a file without an ending, which says its format", "give it the ending of its format"
    else:
        what, fix = f"unknown kind of file '{path.suffix}'", CONVERTED.get(ending, "export the recording as CSV")
    return InputError(what, where=path, expected=", ".join(FORMATS), fix=fix.format(path=path, stem=path.stem))


def _in_bag(path: Path) -> Path:
    """The file in the folder of a ROS 2 bag; other paths as they are. Raises InputError where there are several."""
    kinds = (".mcap", *CONVERTED) if path.is_dir() else ()
    files = next(filter(None, (sorted(path.glob(f"*{kind}")) for kind in kinds)), [])
    if len(files) > 1:
        raise InputError(
            f"the bag is split into {len(files)} files", where=path, expected="a bag of one file",
            fix=f"name one of them, such as {files[0]}, or join them: ros2 bag convert",
        )  # fmt: skip
    return files[0] if files else path
