"""Kills running commands at random moments and asks whether anything was lost: `make kills COUNT=40`.

diagnose over an old result: the old one is whole until the new one is; the next run gives the same bytes as one that
was never killed, and sweeps what was left. trials make and thesis run: what was finished stays, and the run that
resumes ends with the same seal or the same numbers.
"""

from __future__ import annotations

import argparse
import json
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import rwn
from rwn.recording.recording import write_csv
from tools.trust import page
from tools.trust.cases import MODEL
from tools.trust.soak import recording

RWN = (sys.executable, "-m", "rwn")


@dataclass(frozen=True)
class Work:
    """A command in a folder; `result`: what a finished run left, `whole`: whether a killed one left nothing half."""

    command: tuple[str, ...]
    result: Callable[[Path], Any]
    whole: Callable[[Path], bool]


def _diagnosis(folder: Path) -> Any:
    return [(folder / "out" / name).read_bytes() for name in ("diagnosis.json", "corrected.toml")]


def _old_or_new(folder: Path) -> bool:
    text = (folder / "out" / "diagnosis.json").read_text()
    return text == "old" or json.loads(text)["verdict"] != ""


def _seal(folder: Path) -> Any:
    return (folder / "out" / "answers.sha256").read_text()


def _json_is_whole(folder: Path) -> bool:
    for path in (folder / "out").rglob("*.json") if (folder / "out").exists() else ():
        json.loads(path.read_text())
    return True


def _numbers(folder: Path) -> Any:
    found = {path.name: json.loads(path.read_text()) for path in (folder / "out").glob("*.json")}
    return {name: content["rows"] for name, content in found.items()}


WORK = {
    "diagnose": Work(
        ("diagnose", "run.csv", "--model", "motor.toml", "--out", "out", "--overwrite", "--jobs", "1"),
        _diagnosis, _old_or_new,
    ),
    "trials make": Work(
        ("trials", "make", "--seed", "11", "--count", "4", "--out", "out", "--jobs", "1"), _seal, _json_is_whole
    ),
    "thesis run": Work(
        ("thesis", "run", "--table", "5", "--quick", "--jobs", "1", "--out", "out"), _numbers, _json_is_whole
    ),
}  # fmt: skip


def trial(work: Work, seconds: float, expected: Any) -> tuple[bool, str]:
    """Kills one run after `seconds` and finishes it; whether it was at work, and what was lost ("": nothing)."""
    with tempfile.TemporaryDirectory(prefix="rwn-kills-") as name:
        folder = Path(name)
        _prepare(work, folder)
        silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        process = subprocess.Popen([*RWN, *work.command], cwd=folder, **silent)
        time.sleep(seconds)
        alive = process.poll() is None
        process.send_signal(signal.SIGKILL)
        process.wait()
        try:
            if not work.whole(folder):
                return alive, "half a file"
        except (ValueError, OSError) as error:
            return alive, f"half a file: {error}"
        done = subprocess.run([*RWN, *work.command], cwd=folder, capture_output=True, text=True, check=False)
        finished = work.command[:2] == ("trials", "make") and "already holds a finished set" in done.stderr
        if done.returncode and not finished:
            return alive, f"the next run ended with {done.returncode}: {done.stderr[-200:]}"
        if work.result(folder) != expected:
            return alive, "another result than without the kill"
        left = [path.name for path in folder.rglob(".rwn-*")]
        return alive, f"left behind: {left}" if left else ""


def _prepare(work: Work, folder: Path) -> None:
    if work.whole is _old_or_new:
        (folder / "motor.toml").write_text(MODEL)
        made = recording(rwn.read_model(folder / "motor.toml"))
        write_csv(folder / "run.csv", made.time, made.signals)
        (folder / "out").mkdir()
        (folder / "out" / "diagnosis.json").write_text("old")


def main() -> int:
    """Prints kills, how many hit a run at work, and what was lost; 1 where anything was."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=30, help="kills of each command")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=WORK)
    options = page.parsed(parser, "kills")
    draw, rows, bad = random.Random(options.seed), [], []
    for name, work in WORK.items():
        if options.only not in (None, name):
            continue
        folder = Path(tempfile.mkdtemp(prefix="rwn-kills-"))
        _prepare(work, folder)
        start = time.monotonic()
        subprocess.run([*RWN, *work.command], cwd=folder, check=True, capture_output=True)
        took, expected = time.monotonic() - start, work.result(folder)
        shutil.rmtree(folder)
        ends = [trial(work, draw.uniform(0.1, 1.0) * took, expected) for _ in range(options.count)]
        lost = [what for _, what in ends if what]
        bad += [f"{name}: {what}" for what in lost]
        rows.append((name, len(ends), sum(alive for alive, _ in ends), len(lost)))
        print(*rows[-1], file=sys.stderr, flush=True)
    rows.append(("all", *(sum(row[k] for row in rows) for k in (1, 2, 3))))
    heading = ("command", "kills", "of a run at work", "with something lost")
    page.show("kills", options.page, page.table(heading, rows), *bad)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
