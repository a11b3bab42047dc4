"""Kills running commands at random moments and asks whether anything was lost: `make kills COUNT=200`.

A command is started and killed (SIGKILL) again and again in one folder, until it once gets to its end. After each kill
no result is half a file, and what was finished stays and is not made again; the end gives the same bytes as a run that
was never killed, and sweeps what was left. Half of the kills come at a random moment, in processor time, which other
work on the machine does not stretch; half a few calls after a random change of a file, where things are moved into
place. Commands are forked from a process that has loaded rwn. What they work on is short: trials are a sine instead of
a simulated bench, experiments a sum; what writes, keeps, resumes and seals is the command's own.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import sys
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rwn import cli
from rwn.studies.thesis import cli as thesis_cli
from rwn.studies.thesis import page as thesis_page
from rwn.studies.trials import cli as trials_cli
from rwn.studies.trials import make as trials_make
from tools.trust import page
from tools.trust.aside import folder_aside
from tools.trust.killed_commands import WORK, Work
from tools.trust.stopping import until_stopped

LOADED = (thesis_cli, thesis_page, trials_cli)  # in the process that commands are forked from
TICK = 1.0 / os.sysconf("SC_CLK_TCK")  # s, in which Linux states processor time
BEYOND = 1.2  # the last moment of a kill, as a part of a whole run: one of some runs gets to its end
CALLS = 12  # of Python and C, at most, from a change of a file to the kill
WRITES = os.O_WRONLY | os.O_RDWR
CHANGES = ("os.rename", "os.mkdir", "os.remove", "os.rmdir")  # and "open" to write; `sys.addaudithook`


@dataclass
class Tally:
    """expected, seconds, changes: the result, processor time and changes of files of a run that is not killed.
    kills: of a run at work.  ends: runs that got to their end, after some kills.  lost: what was wrong."""

    expected: Any
    seconds: float
    changes: int
    kills: int = 0
    ends: int = 0
    lost: list[str] = field(default_factory=list)


class _Changes:
    """Counts a process's changes of files; some `calls` after the one whose number is `at` it is killed."""

    def __init__(self, at: int | None, calls: int) -> None:
        self.seen, self.at, self.calls = 0, at, calls
        sys.addaudithook(self._hear)

    def _hear(self, event: str, arguments: tuple[Any, ...]) -> None:
        if event in CHANGES or (event == "open" and isinstance(arguments[2], int) and arguments[2] & WRITES):
            self.seen += 1
            if self.seen == self.at:
                sys.setprofile(self._count_down)

    def _count_down(self, *_: object) -> None:
        self.calls -= 1
        if self.calls < 0:
            os.kill(os.getpid(), signal.SIGKILL)


def _start(work: Work, folder: Path, *, change: int | None = None, calls: int = 0) -> int:
    """The process of the command. It is killed at a change of a file, or writes how many it made into `changes`."""
    child = os.fork()
    if child:
        return child
    code = 70
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.chdir(folder)
        said = os.open("said", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(said, 1)
        os.dup2(said, 2)
        sys.stdout, sys.stderr = open(1, "w", closefd=False), open(2, "w", closefd=False)  # noqa: SIM115
        sys.argv = ["rwn", *work.command]
        work.begin()
        changes = _Changes(change, calls)
        try:
            cli.main()
            code = 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
        sys.stdout.flush()
        sys.stderr.flush()
        Path("changes").write_text(str(changes.seen))
    finally:
        os._exit(code)
    return 0


def processor_time(process: int) -> float:
    """Of a process and those that it started [s]; 0 where it has ended."""
    with suppress(OSError):
        words = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        threads = Path(f"/proc/{process}/task").glob("*/children")
        children = [int(child) for path in threads for child in path.read_text().split()]
        return sum(map(int, words[11:15])) * TICK + sum(map(processor_time, children))
    return 0.0


def _wait(process: int, seconds: float | None = None) -> int:
    """The status of a process at its end, -SIGKILL where it is killed, at the latest at `seconds` of processor time."""
    try:
        while True:
            ended, status = os.waitpid(process, 0 if seconds is None else os.WNOHANG)
            if ended:
                return os.waitstatus_to_exitcode(status)
            if seconds is not None and processor_time(process) >= seconds:
                break
            time.sleep(random.uniform(0.0, 2 * TICK))
    except KeyboardInterrupt:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        raise
    os.kill(process, signal.SIGKILL)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


def undisturbed(work: Work) -> Tally:
    """What a run leaves that is not killed."""
    with folder_aside("kills") as folder:
        work.prepare(folder)
        child = _start(work, folder)
        _, status, used = os.wait4(child, 0)
        if status:
            raise RuntimeError(f"{' '.join(work.command)}: {(folder / 'said').read_text()[-2000:]}")
        changes = int((folder / "changes").read_text())
        return Tally(expected=work.result(folder), seconds=used.ru_utime + used.ru_stime, changes=changes)


def chain(work: Work, tally: Tally, draw: random.Random, most: int) -> None:
    """Kills runs in one folder until one gets to its end or there were `most` kills in all; counts into the tally."""
    with folder_aside("kills") as folder:
        work.prepare(folder)
        before: dict[Path, int] = {}
        while tally.kills < most:
            if draw.random() < 0.5:
                code = _wait(_start(work, folder), draw.uniform(0.0, BEYOND) * tally.seconds)
            else:
                at = draw.randint(1, max(round(BEYOND * tally.changes), 1))
                code = _wait(_start(work, folder, change=at, calls=draw.randint(0, CALLS)))
            lost = _lost(work, tally, folder, code, before)
            tally.kills += code == -signal.SIGKILL
            tally.ends += code != -signal.SIGKILL
            if lost:
                tally.lost.append(lost)
            if lost or code != -signal.SIGKILL:
                return
            before = {path: path.stat().st_mtime_ns for path in work.finished(folder)}


def _lost(work: Work, tally: Tally, folder: Path, code: int, before: dict[Path, int]) -> str:
    """What is wrong after a run, killed or at its end; "" where nothing is."""
    try:
        work.check(folder)
        again = [path.name for path, at in before.items() if not path.exists() or path.stat().st_mtime_ns != at]
    except (ValueError, OSError) as error:
        return f"half a file: {error}"
    if again:
        return f"finished, and lost or made again: {again}"
    if code == -signal.SIGKILL:
        return ""
    said = (folder / "said").read_text()
    if code and "already holds a finished set" not in said:
        return f"a run after kills ended with {code}: {said[-300:]}"
    try:
        if work.result(folder) != tally.expected:
            return "another result than without kills"
    except OSError as error:
        return f"no result after kills: {error}"
    left = [path.name for path in folder.rglob("*") if path.name.startswith((".rwn-", trials_make.WORK))]
    return f"left behind: {left}" if left else ""


def main() -> int:
    """Prints kills, runs that got to their end after some, and what was lost; 1 where anything was."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=30, help="kills, of all commands")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=WORK)
    options = page.parsed(parser, "kills")
    names = [name for name in WORK if options.only in (None, name)]
    draw, tallies = random.Random(options.seed), dict[str, Tally]()
    shares = {name: (options.count + k) // len(names) for k, name in enumerate(names)}
    with until_stopped() as stopped:
        for name in names:
            tallies[name] = undisturbed(WORK[name])
        while left := [name for name in names if tallies[name].kills < shares[name] and len(tallies[name].lost) < 10]:
            name = min(left, key=lambda name: tallies[name].kills)
            chain(WORK[name], tallies[name], draw, shares[name])
            print(name, tallies[name].kills, tallies[name].ends, *tallies[name].lost, file=sys.stderr, flush=True)
    rows = [(name, t.kills, t.ends, len(t.lost), f"{t.seconds:.1f}") for name, t in tallies.items()]
    rows.append(("all", *(sum(int(row[k]) for row in rows) for k in (1, 2, 3)), ""))
    heading = ("command", "kills", "runs that ended after kills", "with something lost", "a whole run [s]")
    bad = [f"{name}: {what}" for name, tally in tallies.items() for what in tally.lost]
    how = f"{rows[-1][1]} of {options.count} kills, seed {options.seed}{', stopped' if stopped else ''}."
    page.show("kills", options.page, how, page.table(heading, rows), *bad)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
