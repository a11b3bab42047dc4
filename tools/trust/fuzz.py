"""Fuzzes what reads files and formulas, guided by coverage: `make fuzz SECONDS=60 TARGET=every` (atheris).

A target takes bytes and may raise InputError alone; anything else is a finding, whose bytes are left in the folder
`crash-...`. Inputs that reach new code are kept in the corpus, tests/corpus/TARGET, which a test replays and alters.
"""

from __future__ import annotations

import argparse
import atexit
import re
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from tools.trust.aside import new_folder, sweep

CORPUS = Path(__file__).resolve().parents[2] / "tests" / "corpus"
ROWS = 80  # of the recordings that are simulated
Target = Callable[[bytes], None]


def _written(name: str, data: bytes) -> Path:
    """A new file: one that is emptied first ext4 brings to the disk at once, which takes longer than the input."""
    path = _FOLDER / name
    path.unlink(missing_ok=True)
    path.write_bytes(data)
    return path


def _reads(ending: str) -> Target:
    def read(data: bytes) -> None:
        from rwn.errors import InputError
        from rwn.recording.layout import Layout
        from rwn.recording.recording import read_recording

        path = _written(f"x{ending}", data)
        part = "#slow-forward" if ending == ".json" else ""
        for layout in (Layout(), Layout(sample_time=1e-3, profile="moteus")):
            with suppress(InputError):
                read_recording(f"{path}{part}", layout=layout)

    return read


def model(data: bytes) -> None:
    """A model file."""
    from rwn.errors import InputError
    from rwn.model.toml_reader import parse_model
    from rwn.model.toml_writer import format_model

    with suppress(InputError):
        found = parse_model(data.decode("utf-8", "replace"), where="x.toml")
        again = parse_model(format_model(found), where="x.toml")
        assert again.parameters == found.parameters, "what is written is read back"


def formula(data: bytes) -> None:
    """The formula of an effect of a user's own."""
    import json

    from rwn.errors import InputError
    from rwn.model.toml_reader import parse_model
    from tools.trust.cases import MODEL, OWN

    text = json.dumps(data.decode("utf-8", "replace")).encode("ascii", "replace").decode()[1:-1]
    with suppress(InputError):
        parse_model(MODEL + OWN.replace("{}", text, 1), where="x.toml")


def diagnosis(data: bytes) -> None:
    """diagnosis.json, and a page of it."""
    from rwn.errors import InputError
    from rwn.report.diagnosis import Diagnosis

    _written("diagnosis.json", data)
    with suppress(InputError):
        Diagnosis.load(_FOLDER)


def simulation(data: bytes) -> None:
    """Whatever numbers as motor, effect and input: what the checks let pass goes through the bindings to kernels."""
    import numpy as np

    import rwn
    from rwn.errors import InputError
    from rwn.model.drives import KINDS
    from rwn.model.vocabulary import table

    numbers = np.frombuffer(data[1 : 1 + (len(data) - 1) // 8 * 8])
    effect = list(table().values())[data[0] % len(table())] if data else None
    motor = [p.name for p in KINDS["dc"].nominal_parameters(0)]
    of_effect = [p.name for p in effect.parameters] if effect else []
    if effect is None or numbers.size <= len(motor) + len(of_effect):
        return
    values = numbers.tolist()
    law = dict(zip(of_effect, values[len(motor) :], strict=False))
    voltage = np.resize(numbers[len(motor) + len(law) :], ROWS)
    with suppress(InputError):
        model = rwn.Model(kind="dc", parameters=dict(zip(motor, values, strict=False)), effects={effect.name: law})
        run = rwn.simulate(model, rwn.Recording(name="x", time=1e-3 * np.arange(ROWS), signals={"voltage": voltage}))
        assert all(np.isfinite(x).all() for x in run.signals.values()), "no NaN silently"


_FOLDER = new_folder("fuzz")  # gone when the process ends by itself, which atheris does not let one do
atexit.register(shutil.rmtree, _FOLDER, ignore_errors=True)
TARGETS: dict[str, Target] = {
    "csv": _reads(".csv"), "wpilog": _reads(".wpilog"), "sysid": _reads(".json"), "npz": _reads(".npz"),
    "mat": _reads(".mat"), "parquet": _reads(".parquet"), "excel": _reads(".xlsx"), "mcap": _reads(".mcap"),
    "tdms": _reads(".tdms"), "mf4": _reads(".mf4"), "model": model, "formula": formula, "diagnosis": diagnosis,
    "simulation": simulation,
}  # fmt: skip


def main() -> int:
    """Fuzzes one target, or every in turn, each in a process of its own; 1 where one found something."""
    from tools.trust import page
    from tools.trust.stopping import until_stopped

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", choices=(*TARGETS, "every"))
    parser.add_argument("--seconds", type=int, default=60, help="for each target")
    options = page.parsed(parser, "fuzz")
    targets = TARGETS if options.target == "every" else (options.target,)
    rows: list[tuple[str, str, int, int, int]] = []
    crashes: list[str] = []
    with until_stopped() as stopped:
        for target in targets:
            _fuzzed(target, options.seconds, rows, crashes)
    rows.append(("all", f"{sum(float(row[1]) for row in rows):.0f}", *(sum(row[k] for row in rows) for k in (2, 3, 4))))
    heading = ("target", "processor time [s]", "inputs tried", "kept in the corpus", "findings")
    how = f"{options.seconds} s a target, {len(rows) - 1} of {len(targets)} targets{', stopped' if stopped else ''}."
    page.show("fuzz", options.page, how, page.table(heading, rows), *crashes)
    return 1 if crashes else 0


def _fuzzed(target: str, seconds: int, rows: list[tuple[str, str, int, int, int]], crashes: list[str]) -> None:
    """Fuzzes a target in a process of its own; its row of the table, and what it found."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = f"from tools.trust.fuzz import fuzz; fuzz({target!r}, {seconds})"
    done = subprocess.run([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True, check=False)
    sweep("fuzz")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    tried = re.findall(r"stat::number_of_executed_units:\s*(\d+)|^#(\d+)\s", done.stderr, re.MULTILINE)
    inputs = max((int(a or b) for a, b in tried), default=0)
    if done.returncode:
        crashes.append(f"{target}: exit code {done.returncode}: {done.stderr[-2000:]}")
    rows.append((target, f"{took:.0f}", inputs, len(list((CORPUS / target).iterdir())), int(done.returncode != 0)))
    print(*rows[-1], file=sys.stderr, flush=True)


def fuzz(target: str, seconds: int) -> None:
    """Fuzzes one target for a while; atheris ends the process."""
    import atheris

    with atheris.instrument_imports(include=["rwn"]):
        import rwn.report.diagnosis  # noqa: F401

    corpus = CORPUS / target
    corpus.mkdir(parents=True, exist_ok=True)
    arguments = [sys.argv[0], str(corpus), f"-max_total_time={seconds}", "-timeout=20", "-max_len=8192",
                 "-rss_limit_mb=3000", "-print_final_stats=1"]  # fmt: skip
    TARGETS[target](b"")  # loads the library of a format, which is not the time of an input
    atheris.Setup(arguments, TARGETS[target])
    atheris.Fuzz()


if __name__ == "__main__":
    sys.exit(main())
