"""Names that are true of a bench trial beside the effects concealed in it: what its imperfections are called."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

LATE = frozenset({"input-delay", "speed-sensor-lag", "current-sensor-lag"})
DELAYED = {"speed-sensor-lag": "speed-sensor-delay", "current-sensor-lag": "current-sensor-delay"}
DELAYS = frozenset({"late-channel", "values-held", "encoder-difference"})  # imperfections that show what was before
LATE_RECORDING = "time-shift"  # right where a channel is late
AVERAGED = "speed-moving-average"  # what is late because it is held or a difference over rows, in other words
ROUNDED = "sensor-quantization"  # an encoder's speed lies on steps
OFFSET = "sensor-bias"  # of the speed or the current


def also_true(answer: Mapping[str, Any]) -> set[str]:
    """The names that the answer has, and those that trials made before their rule was known do not have."""
    names = set(answer.get("also_true", ()))
    names |= {LATE_RECORDING} if names & LATE else set()
    if DELAYS & {each["kind"] for each in answer.get("imperfections", ())}:
        names |= {late for lagging, late in DELAYED.items() if lagging in names}
    names |= {AVERAGED} if "speed-sensor-lag" in names else set()
    names |= {ROUNDED} if answer["noise"]["kind"] == "encoder" else set()
    offsets = [each for each in answer.get("imperfections", ()) if each["kind"] == "zero-offset"]
    return names | ({OFFSET} if any(each["speed"] or each["current"] for each in offsets) else set())
