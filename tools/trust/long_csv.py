"""Time and memory of reading a long CSV of four columns: `make long-csv COUNT=10000000` (pyarrow writes it)."""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np

from tools.trust import page
from tools.trust.aside import folder_aside

READ = """
import sys, rwn
recording = rwn.read_recording(sys.argv[1])
assert len(recording) == int(sys.argv[2]), len(recording)
"""


def write(path: Path, rows: int) -> None:
    """Time, voltage, current and speed, six digits each, in pieces."""
    import pyarrow as pa
    from pyarrow import csv

    names = ("time [s]", "voltage [V]", "current [A]", "speed [rad/s]")
    piece, rng = 10**6, np.random.default_rng(0)
    with path.open("wb") as file:
        file.write((",".join(names) + "\n").encode())
        for start in range(0, rows, piece):
            time = np.arange(start, min(start + piece, rows)) * 1e-4
            noise = rng.normal(0.0, 1.0, (3, time.size)).round(5)
            table = pa.table(dict(zip(names, (time.round(4), *noise), strict=True)))
            csv.write_csv(table, file, csv.WriteOptions(include_header=False))


def main() -> None:
    """Prints the size of the file, and processor time and memory of a process that reads it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10**7, help="rows")
    options = page.parsed(parser, "long-csv")
    with folder_aside("long-csv") as folder:
        path = folder / "long.csv"
        write(path, options.count)
        subprocess.run([sys.executable, "-c", READ, str(path), str(options.count)], check=True)
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        page.show(
            "long-csv", options.page,
            f"{options.count} rows of 4 columns, {path.stat().st_size / 1e6:.0f} MB: "
            f"{used.ru_utime + used.ru_stime:.1f} s of processor time, {used.ru_maxrss / 1e3:.0f} MB of memory."
        )  # fmt: skip


if __name__ == "__main__":
    main()
