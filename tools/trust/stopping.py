"""What takes long may be stopped, and shows what it has found until then."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def until_stopped() -> Iterator[list[str]]:
    """Ctrl-C or SIGTERM ends the block and no more; the list, empty before, then has the word that says so."""

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    stopped: list[str] = []
    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stopped
    except KeyboardInterrupt:
        stopped.append("stopped")
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
