"""Progress: a bar with the time that is left on a terminal, a line for each stage elsewhere."""

from __future__ import annotations

import time
from types import TracebackType
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from rich.progress import Progress as Bar
    from rich.progress import TaskID

EARLIEST = 0.05  # share that must be done before the time that is left is worth an estimate


class Progress:
    """Callable as `progress(stage, fraction)`, fraction 0 to 1; where it falls, a search is done once more.

    The further search is counted where it is shown, and the time that is left is that of it.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._began = time.monotonic()
        self._stage, self._done = "", 0.0
        self._search = 1
        self._bar: Bar | None = None
        self._task: TaskID | None = None

    def __call__(self, stage: str, fraction: float) -> None:
        if fraction < self._done:
            self._began = time.monotonic()
            self._search += 1
        self._done = fraction
        if self._search > 1:
            stage = f"search {self._search}: {stage}"
        if self._bar is not None and self._task is not None:
            left = remaining(time.monotonic() - self._began, fraction)
            if left and self._search > 1:
                left += " of this search"
            self._bar.update(self._task, completed=fraction, description=stage, left=left)
        elif stage != self._stage:
            self._stream.write(f"{100 * fraction:3.0f} %  {stage}\n")
            self._stream.flush()
        self._stage = stage

    def __enter__(self) -> Progress:
        if self._stream.isatty():
            from rich.console import Console  # late: the command line starts without it
            from rich.progress import BarColumn, TaskProgressColumn, TextColumn, TimeElapsedColumn
            from rich.progress import Progress as Bar

            columns = (
                TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeElapsedColumn(),
                TextColumn("{task.fields[left]}"),
            )  # fmt: skip
            self._bar = Bar(*columns, console=Console(file=self._stream), transient=True)
            self._task = self._bar.add_task("reading", total=1.0, left="")
            self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()


def remaining(elapsed: float, fraction: float) -> str:
    """The time that is left if the rest goes on as so far: "about 40 s left"; empty where it is too early to say."""
    if not EARLIEST <= fraction < 1.0:
        return ""
    seconds = elapsed * (1.0 - fraction) / fraction
    return f"about {seconds:.0f} s left" if seconds < 100.0 else f"about {seconds / 60.0:.0f} min left"
