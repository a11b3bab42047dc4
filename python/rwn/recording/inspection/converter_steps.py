"""The steps of a coarse converter beneath what came to a signal behind it: noise or hum of a line, or of a logger.

The values lie near the multiples of a step. The signal as the converter gave it is in these.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rwn.recording.inspection.finding import Finding
from rwn.recording.noisy_steps import NoisySteps, noisy_steps
from rwn.recording.recording import Recording
from rwn.recording.signals import MEASURED, SIGNALS, si_unit

Array = NDArray[np.float64]


def without_noise_on_steps(recording: Recording) -> tuple[Recording, list[Finding]]:
    """The recording with the signals of coarse converters on their steps, and what was found.

    Samples that lie between steps, as those that a logger made of their neighbours, are left out.
    """
    findings = list[Finding]()
    for signal in (s for s in MEASURED if s in recording.signals):
        missing = recording.missing.get(signal, np.zeros(len(recording), dtype=bool))
        values = np.asarray(recording.signals[signal])
        steps = noisy_steps(values[~missing])
        if steps is None:
            continue
        lost = missing | ~steps.holds(values)
        recording = replace(
            recording,
            signals={**recording.signals, signal: np.where(lost, values, steps.nearest(values))},
            missing={**recording.missing, signal: lost},
        )
        findings.append(_finding(recording, signal, steps, int(np.count_nonzero(lost & ~missing))))
    return recording, findings


def _finding(recording: Recording, signal: str, steps: NoisySteps, between: int) -> Finding:
    unit = si_unit(SIGNALS[signal], recording.linear)
    lie = f", {between} samples between them" if between else ""
    return Finding(
        kind="converter-steps", recording=recording.name, signals=(signal,), count=len(recording),
        words=f"the {signal} lies near steps of {steps.step:.3g} {unit}, {steps.noise:.2g} {unit} off them{lie}",
        done="taken on its steps" + (", those between left out" if between else ""),
    )  # fmt: skip
