"""Progress on one line of a terminal; silent elsewhere."""

from __future__ import annotations

import time
from types import TracebackType
from typing import TextIO


class Progress:
    """Callable as `progress(stage, fraction)`, fraction 0 to 1; redraws at most ten times a second."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._shown = stream.isatty()
        self._last = -1.0

    def __call__(self, stage: str, fraction: float) -> None:
        now = time.monotonic()
        if self._shown and now - self._last > 0.1:
            self._last = now
            self._stream.write(f"\r\x1b[K{100 * fraction:3.0f} %  {stage}"[:110])
            self._stream.flush()

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._shown:
            self._stream.write("\r\x1b[K")
