"""A speed and a position that contradict each other: one of them has a wrong unit, sign or gear ratio."""

from __future__ import annotations

from collections.abc import Iterator

from rwn.recording.inspection.finding import Finding
from rwn.recording.kinematics import kinematics_of
from rwn.recording.recording import Recording


def contradictions(recording: Recording) -> Iterator[Finding]:
    """The finding, if there is one."""
    motion = kinematics_of(recording)
    if motion is None or not motion.contradict:
        return
    turned = ", of the other sign," if motion.ratio < 0.0 else ""
    yield Finding(
        kind="contradiction", recording=recording.name, signals=("speed", "position"), count=len(recording),
        words=f"the speed is {abs(motion.ratio):.3g} times the rate{turned} at which the position changes: one of "
        "the two has a wrong unit, sign or gear ratio",
        done="a diagnosis undoes it where a unit or a sign makes them agree",
    )  # fmt: skip
