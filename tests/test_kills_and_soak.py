"""The figures of kills and of memory would show what they ask for, and show what they have when they are stopped."""

from __future__ import annotations

import os
import random
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))  # tools are no part of the package

from tools.trust import killed_commands, kills  # noqa: E402
from tools.trust.kills import Tally, Work, chain, undisturbed  # noqa: E402
from tools.trust.soak import EVERY, growth  # noqa: E402
from tools.trust.stopping import until_stopped  # noqa: E402

from rwn import cli  # noqa: E402

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="forks a process that has loaded rwn")


def _names(folder: Path) -> list[str]:
    return sorted(path.name for path in (folder / "out").glob("*.json"))


def _work(write: Callable[[Path], None]) -> Work:
    """Three files, each written unless it is there."""

    def command() -> None:
        Path("out").mkdir(exist_ok=True)
        for k in range(3):
            path = Path(f"out/{k}.json")
            if not path.exists():
                write(path)

    def begin() -> None:
        cli.main = command  # in the process of the command alone

    finished = lambda folder: sorted((folder / "out").glob("*.json"))  # noqa: E731
    return Work((), _names, killed_commands._json_is_whole, finished=finished, begin=begin)


def _whole(path: Path) -> None:
    aside = path.with_suffix(".partial")
    aside.write_text("[1]")
    aside.replace(path)


def _in_place(path: Path) -> None:
    path.write_text("[1]")


def _counted(work: Work, most: int) -> Tally:
    tally, draw = undisturbed(work), random.Random(0)
    while tally.kills < most and not tally.lost:
        chain(work, tally, draw, most)
    return tally


@pytest.mark.slow
def test_files_that_are_moved_into_place_lose_nothing() -> None:
    tally = _counted(_work(_whole), 30)
    assert tally.expected == ["0.json", "1.json", "2.json"]
    assert (tally.kills, tally.lost) == (30, [])
    assert tally.ends > 0


def test_files_that_are_written_in_place_are_found_half() -> None:
    tally = _counted(_work(_in_place), 200)
    assert tally.lost
    assert tally.lost[0].startswith("half a file")


def test_what_is_made_again_or_ends_otherwise_is_lost(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "said").write_text("rwn: no")
    path, work, tally = tmp_path / "out" / "0.json", _work(_whole), Tally(["0.json"], 1.0, 1)
    _whole(path)
    at = path.stat().st_mtime_ns
    lost = kills._lost
    assert lost(work, tally, tmp_path, 0, {path: at}) == ""
    assert "made again: ['0.json']" in lost(work, tally, tmp_path, -signal.SIGKILL, {path: at - 1})
    assert "ended with 2: rwn: no" in lost(work, tally, tmp_path, 2, {})
    assert "another result" in lost(work, Tally([], 1.0, 1), tmp_path, 0, {})
    (tmp_path / ".rwn-1").mkdir()
    assert lost(work, tally, tmp_path, 0, {}) == "left behind: ['.rwn-1']"
    assert lost(work, tally, tmp_path, -signal.SIGKILL, {}) == ""


def test_growth_is_of_the_last_half_and_of_a_diagnosis() -> None:
    assert growth([0.0, 500.0, 700.0, 700.0, 700.0, 700.0]) == pytest.approx(0.0, abs=1e-9)
    assert growth([0.0, 0.0, 3.0 * EVERY, 6.0 * EVERY]) == pytest.approx(3.0)
    assert growth([1.0]) == 0.0
    assert growth([1.0] * 60 + [2300.0] * 40) == 0.0, "one step of the allocator"
    leak = [100.0 * (k // 9) for k in range(100)]  # by arenas: 100 kB every 90 diagnoses
    assert growth(leak) == pytest.approx(100.0 / 90.0, rel=0.1)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_what_is_stopped_goes_on_after_the_block(number: signal.Signals) -> None:
    before, reached = signal.getsignal(number), []
    with until_stopped() as stopped:
        reached.append(1)
        os.kill(os.getpid(), number)
        reached.append(2)
    assert (reached, stopped) == ([1], ["stopped"])
    assert signal.getsignal(number) is before
    with until_stopped() as stopped:
        pass
    assert stopped == []
