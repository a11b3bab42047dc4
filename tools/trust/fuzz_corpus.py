"""Alters the corpus of fuzzing, unguided, with nothing but what tests need: `make fuzz-corpus SECONDS=600`.

Input number k of a target is the same wherever the same code runs; time says only how far the numbers go, so that what
passed once passes again. A target runs in a process of its own, which a finding ends: an exception other than
InputError, a crash, a hang, or more memory than allowed. Its bytes are kept, and `altered` makes them anywhere. Moved
into tests/corpus/TARGET they are tried with every run of the tests.
"""

from __future__ import annotations

import argparse
import faulthandler
import math
import os
import random
import resource
import signal
import sys
import time
import traceback
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from tools.trust import fuzz, page
from tools.trust.aside import folder_aside
from tools.trust.cases import damage
from tools.trust.stopping import until_stopped

KEPT = Path(__file__).resolve().parents[2] / "build" / "fuzz-corpus"
HANG, WAITED, BYTES = 20, 120, 4 * 2**30  # of one input: processor time and waiting [s]; memory of a process
MOST = 3  # findings after which a target is left


@dataclass(kw_only=True)
class Tried:
    """A target. until: when it is stopped, as time.time() counts.  number: of the next input, so how many were tried.
    seconds: processor time.  cut: the deadline came first."""

    target: str
    until: float = math.inf
    number: int = 0
    seconds: float = 0.0
    cut: bool = False
    findings: list[str] = field(default_factory=list)

    def row(self) -> tuple[str, int, str, int]:
        """Of the table."""
        return (self.target, self.number, f"{self.seconds:.0f}", len(self.findings))


@cache
def _corpus(target: str) -> list[bytes]:
    return [path.read_bytes() for path in sorted((fuzz.CORPUS / target).iterdir())]


def altered(target: str, number: int) -> bytes:
    """An input of a target, which these two alone decide."""
    draw = random.Random(f"{target} {number}")
    return damage(draw.choice(_corpus(target)), draw)


def fuzzed(targets: Sequence[str], *, seconds: float, until: float, jobs: int, kept: Path) -> Iterator[Tried]:
    """Each target as it ends: after its part of the processor time, or of the time that is left until the deadline."""
    waiting = [Tried(target=target) for target in targets]
    running: dict[int, Tried] = {}
    share = seconds / len(targets)
    with folder_aside("fuzz-corpus") as aside:
        try:
            while waiting or running:
                while waiting and len(running) < jobs:
                    rounds, now = math.ceil(len(waiting) / jobs), time.time()
                    tried = waiting.pop(0)
                    tried.until = now + max(until - now, 0.0) / rounds
                    running[_start(tried, share, aside)] = tried
                time.sleep(0.02)
                for pid in list(running):
                    tried = running[pid]
                    if _ended(pid, tried, aside, kept):
                        del running[pid]
                        if tried.cut or tried.seconds >= share or len(tried.findings) == MOST:
                            yield tried
                        else:
                            running[_start(tried, share, aside)] = tried
        finally:
            for pid in running:
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)


def _start(tried: Tried, share: float, aside: Path) -> int:
    (aside / tried.target).write_text(str(tried.number))
    child = os.fork()
    if child == 0:
        _run(tried, share - tried.seconds, aside)
    return child


def _run(tried: Tried, seconds: float, aside: Path) -> None:
    """In the child: never returns. The number of each input is written down before it is tried."""
    code = 1
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.dup2(os.open(aside / f"{tried.target}.said", os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), 2)
        sys.stderr = open(2, "w", buffering=1, errors="replace", closefd=False)  # noqa: SIM115
        faulthandler.enable(2)
        for number in (signal.SIGPROF, signal.SIGALRM):  # where it hangs is said; then the signal ends the process
            signal.signal(number, signal.SIG_DFL)
            faulthandler.register(number, 2, chain=True)
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        target, at = fuzz.TARGETS[tried.target], os.open(aside / tried.target, os.O_WRONLY)
        target(b"")  # loads the library of a format, which is not the time of an input
        while sum(os.times()[:4]) < seconds:
            signal.setitimer(signal.ITIMER_PROF, HANG)
            signal.setitimer(signal.ITIMER_REAL, WAITED)
            target(altered(tried.target, tried.number))
            tried.number += 1
            os.pwrite(at, str(tried.number).encode(), 0)
        code = 0
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(code)


def _ended(pid: int, tried: Tried, aside: Path, kept: Path) -> bool:
    """Whether the process has ended, by itself or as its time is over; a finding is kept, the next input named."""
    tried.cut = time.time() >= tried.until
    if tried.cut:
        os.kill(pid, signal.SIGKILL)
    ended, status, used = os.wait4(pid, 0 if tried.cut else os.WNOHANG)
    if not ended:
        return False
    tried.seconds += used.ru_utime + used.ru_stime
    tried.number = int((aside / tried.target).read_text())
    if status and not tried.cut:
        path = kept / f"{tried.target}-{tried.number}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(altered(tried.target, tried.number))
        said = (aside / f"{tried.target}.said").read_text(errors="replace")
        where = said[-2000:] if os.WIFEXITED(status) else said[:2000]  # Python's last lines or faulthandler's first
        tried.findings.append(f"{path}: {_how(status)}\n{where}")
        tried.number += 1
    return True


def _how(status: int) -> str:
    code = os.waitstatus_to_exitcode(status)
    if code in (-signal.SIGPROF, -signal.SIGALRM):
        return f"hangs: over {HANG if code == -signal.SIGPROF else WAITED} s"
    return "raises" if code > 0 else f"crashes: {signal.Signals(-code).name}"


def main() -> int:
    """Tries every target, some beside each other; 1 where one found something."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", choices=(*fuzz.TARGETS, "every"))
    parser.add_argument("--seconds", type=float, default=600, help="of processor time, over all targets")
    parser.add_argument("--until", type=float, default=math.inf, help="the end at the latest, in seconds since 1970")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes beside each other")
    options = page.parsed(parser, "fuzz-corpus")
    targets = list(fuzz.TARGETS) if options.target == "every" else [options.target]
    done: list[Tried] = []
    with until_stopped() as stopped:
        for tried in fuzzed(targets, seconds=options.seconds, until=options.until, jobs=options.jobs, kept=KEPT):
            done.append(tried)
            print(*tried.row(), file=sys.stderr, flush=True)
    took = sum(tried.seconds for tried in done)
    findings = [finding for tried in done for finding in tried.findings]
    rows = sorted((tried.row() for tried in done), key=lambda row: targets.index(row[0]))
    rows.append(("all", sum(tried.number for tried in done), f"{took:.0f}", len(findings)))
    how = f"{took:.0f} of {options.seconds:.0f} s of processor time, {len(done)} of {len(targets)} targets"
    why = "; the deadline came first" if any(tried.cut for tried in done) else ", stopped" if stopped else ""
    heading = ("target", "inputs tried", "processor time [s]", "findings")
    page.show("fuzz-corpus", options.page, f"{how}{why}.", page.table(heading, rows), *findings)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
