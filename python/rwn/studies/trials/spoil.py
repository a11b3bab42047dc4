"""Recording mistakes put into a finished set of blind trials: a unit, a sign, a gear ratio, a channel out of step.

The training recordings of a trial all get the same mistake, drawn from the seed of the set; the held-out ones stay
right, so that what is found beneath the mistake can be proved on them.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rwn.recording.signals import MOTION
from rwn.studies.trials.adapter import train_files
from rwn.studies.trials.bench import Recording
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.plant import Array
from rwn.studies.trials.seal import ANSWERS, seal, unseal
from rwn.studies.trials.trial_files import read_columns, write_recording

Columns = dict[str, Array]
Rng = np.random.Generator
SHIFTS = (3, 15)  # samples, early or late
RATIOS = (2.5, 12.0)  # of a gear between the motor and the sensor


@dataclass(frozen=True)
class Spoilt:
    """What is wrong: the recorded signal is `factor` times the true one, `delay` samples late."""

    name: str
    signals: tuple[str, ...]
    factor: float = 1.0
    delay: int = 0

    def applied(self, columns: Columns) -> Columns:
        """The recording with it: a late channel waits at its first value; where one is early, all end with it."""
        late, early = max(self.delay, 0), max(-self.delay, 0)
        rows = len(columns["time"]) - early
        out = {name: values[:rows] for name, values in columns.items()}
        for name in self.signals:
            if name in columns:
                moved = columns[name][early : early + rows - late]
                out[name] = self.factor * np.concatenate([np.full(late, moved[0]), moved])
        return out


def _unit(rng: Rng, present: set[str]) -> Spoilt:
    units = {"speed": 60.0 / (2.0 * np.pi), "position": 180.0 / np.pi, "current": 1e3}  # rpm, degrees, mA
    signal = str(rng.choice(sorted(present & set(units))))
    return Spoilt("wrong-unit", (signal,), factor=float(units[signal]))


def _sign(rng: Rng, present: set[str]) -> Spoilt:
    signals = [MOTION] + ([("current",)] if "current" in present else [])
    return Spoilt("wrong-sign", signals[int(rng.integers(len(signals)))], factor=-1.0)


def _gear(rng: Rng, _: set[str]) -> Spoilt:
    return Spoilt("wrong-gear-ratio", MOTION, factor=1.0 / float(np.exp(rng.uniform(*np.log(RATIOS)))))


def _shift(rng: Rng, _: set[str]) -> Spoilt:
    signals = MOTION if rng.random() < 0.5 else ("current",)
    delay = int(rng.integers(SHIFTS[0], SHIFTS[1] + 1)) * (1 if rng.random() < 0.5 else -1)
    return Spoilt("time-shift", signals, delay=delay)


KINDS: dict[str, Callable[[Rng, set[str]], Spoilt]] = {
    "wrong-unit": _unit, "wrong-sign": _sign, "wrong-gear-ratio": _gear, "time-shift": _shift,
}  # fmt: skip


def spoil(folder: Path, out: Path) -> str:
    """Writes the set in `folder` with a mistake in every trial to `out`; returns the SHA-256 of the sealed answers.

    The answers of `folder` are opened for their seed alone and sealed again with the mistakes. Raises FileExistsError
    where anything lies in `out`, ValueError where `folder` is no finished set, SealBrokenError where it was changed.
    """
    if not (folder / ANSWERS).exists():
        raise ValueError(f"{folder} holds no {ANSWERS}; give a folder that `rwn trials make` has finished")
    if out.exists() and any(out.iterdir()):
        raise FileExistsError(f"{out} is not empty; choose another folder")
    with reading(folder / ANSWERS):
        content = unseal(folder)
        answers, seed = sorted(content["answers"].items()), int(content["seed"])
    kinds = list(KINDS)
    for index, (name, answer) in enumerate(answers):
        rng = np.random.default_rng([seed, index, 7])
        answer["mistake"] = _spoil_trial(folder / name, out / name, kinds[index % len(kinds)], rng)
    return seal(out, content)


def _spoil_trial(trial: Path, out: Path, kind: str, rng: Rng) -> dict[str, Any]:
    shutil.copytree(trial, out, ignore=shutil.ignore_patterns("out"))
    files = train_files(out)
    present = set(read_columns(files[0]))
    if kind == "time-shift" and "current" not in present:
        kind = "wrong-gear-ratio"  # late against the voltage alone is as well a delay of the drive
    mistake = KINDS[kind](rng, present)
    for path in files:
        write_recording(path, Recording(**mistake.applied(read_columns(path))))
    signals = [s for s in mistake.signals if s in present]
    return {"name": mistake.name, "signals": signals, "factor": mistake.factor, "delay": mistake.delay}
