"""Diagnoses the same small recording again and again in one process, and prints its memory: `make soak COUNT=1000`.

The least effort: every stage of a diagnosis runs, and few pairs of effects are tried. Stopped, it shows what it has.
Exit code 1 where the answers differ, or where memory grows over the last half of the runs by more than 4 kB a
diagnosis: a leak of one array of 500 samples in each would show.
"""

from __future__ import annotations

import argparse
import gc
import hashlib
import re
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import rwn
from rwn.diagnose import LEAST_EFFORT
from tools.trust import page
from tools.trust.stopping import until_stopped

GROWTH = 4.0  # kB a diagnosis
EVERY = 10  # diagnoses between two looks at the memory: what is no longer in use is collected before each
MOTOR = {
    "resistance": 0.8, "inductance": 1.5e-3, "torque_constant": 0.1, "back_emf_constant": 0.1, "inertia": 3e-4,
    "viscous_friction": 7e-5,
}  # fmt: skip


def recording(model: rwn.Model) -> rwn.Recording:
    """0.3 s of a motor with dry friction, with noise."""
    time_, rng = np.arange(300) * 1e-3, np.random.default_rng(0)
    voltage = 5.0 * np.sin(40.0 * time_)
    made = rwn.Model(kind="dc", parameters=MOTOR, effects={"coulomb-friction": {"coulomb_torque": 0.02}})
    run = rwn.simulate(made, rwn.Recording(name="run", time=time_, signals={"voltage": voltage}))
    signals = {"voltage": voltage} | {s: run.signals[s] + rng.normal(0, 0.02, 300) for s in ("current", "speed")}
    return rwn.Recording(name="run", time=time_, signals=signals, linear=model.linear)


def resident() -> float:
    """Memory that this process has written [kB]; what is mapped of files comes and goes as the system likes."""
    gc.collect()
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    return float(re.findall(r"RssAnon:\s+(\d+) kB", status)[0])


def growth(memory: Sequence[float]) -> float:
    """Over the last half of what was measured every EVERY diagnoses [kB a diagnosis]; 0 of fewer than two.

    The median of the slopes between any two (Theil, Sen): a leak grows with each, the allocator takes one step for all.
    """
    half = np.asarray(memory[len(memory) // 2 :])
    first, second = np.triu_indices(half.size, k=1)
    return float(np.median((half[second] - half[first]) / (second - first))) / EVERY if half.size > 1 else 0.0


def main() -> int:
    """Prints memory at ten moments and its growth."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    options = page.parsed(parser, "soak")
    model = rwn.Model(kind="dc", parameters=MOTOR, uncertainty={"inertia": 0.1, "viscous_friction": 0.3})
    run, answers, memory, start = recording(model), Counter[str](), list[float](), time.process_time()
    with until_stopped() as stopped:
        for k in range(1, options.count + 1):
            found = rwn.diagnose(run, model, jobs=1, effort=LEAST_EFFORT)
            answers[hashlib.sha256(found.to_json()).hexdigest()] += 1
            if k % EVERY == 0:
                memory.append(resident())
                print(f"{k} diagnoses: {memory[-1] / 1024:.1f} MB", file=sys.stderr, flush=True)
    took, grows, done = time.process_time() - start, growth(memory), answers.total()
    ends = f"{memory[0] / 1024:.1f} MB after {EVERY}, {memory[-1] / 1024:.1f} MB at the end; " if memory else ""
    page.show(
        "soak", options.page,
        f"{done} of {options.count} diagnoses{', stopped' if stopped else ''}, in one process, of {run.time.size} "
        f"samples at `effort={LEAST_EFFORT}`: {len(answers)} answer(s), {took:.0f} s of processor time. {ends}"
        f"{grows:+.2f} kB a diagnosis over the last half.",
    )  # fmt: skip
    return 1 if grows > GROWTH or len(answers) != 1 else 0


if __name__ == "__main__":
    sys.exit(main())
