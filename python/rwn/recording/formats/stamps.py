"""Instants as text, as loggers write them: 2024-01-01T12:00:00.001+01:00, 01.01.2024 12:00:00,001, 12:00:00.001."""

from __future__ import annotations

import re

import numpy as np

_STAMP = re.compile(
    r"\s*((?P<day>\d{4}[-/]\d\d[-/]\d\d|\d\d\.\d\d\.\d{4})[T ]+)?"
    r"(?P<clock>\d\d:\d\d(:\d\d([.,]\d{1,9})?)?)"
    r"\s*(?P<zone>Z|(?P<sign>[+-])(?P<hours>\d\d):?(?P<minutes>\d\d))?\s*",
)

ANY_DAY = "1970-01-01"  # of a time of day


def instant(cell: str) -> np.datetime64 | None:
    """The instant that a cell holds, to the nanosecond; of a zone, in UTC. None where it is none."""
    found = _STAMP.fullmatch(cell)
    if found is None:
        return None
    day = (found["day"] or ANY_DAY).replace("/", "-")
    if "." in day:
        day = "-".join(reversed(day.split(".")))
    try:
        local = np.datetime64(f"{day}T{found['clock'].replace(',', '.')}", "ns")
    except ValueError:  # the 31st of June
        return None
    minutes = 60 * int(found["hours"]) + int(found["minutes"]) if found["sign"] else 0
    return local - np.timedelta64(-minutes if found["sign"] == "-" else minutes, "m")


class Stamps:
    """A column of instants: each as the time since the first [s]."""

    def __init__(self, first: np.datetime64) -> None:
        self._first = first

    def seconds(self, cell: str) -> float:
        """Raises ValueError where a cell is no instant."""
        at = instant(cell)
        if at is None:
            raise ValueError(cell)
        return float((at - self._first) / np.timedelta64(1, "s"))
