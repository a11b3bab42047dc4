from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

PARENT = """
import os, time
from pathlib import Path
from rwn.studies.trials.workers import workers

def stay(folder):
    (folder / str(os.getpid())).touch()
    time.sleep(600)

if __name__ == "__main__":
    folder = Path(__file__).parent / "pids"
    with workers(2) as pool:
        list(pool.map(stay, [folder] * 2))
"""


def lives(pid: int) -> bool:
    """A zombie is dead: its state is Z."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def until(condition: Callable[[], bool], seconds: float) -> bool:
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.05)
    return condition()


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="looks at processes through /proc")
@pytest.mark.parametrize("by", [signal.SIGTERM, signal.SIGKILL])
def test_workers_end_with_a_killed_parent(tmp_path: Path, by: signal.Signals) -> None:
    script, pids = tmp_path / "parent.py", tmp_path / "pids"
    script.write_text(PARENT)
    pids.mkdir()
    parent = subprocess.Popen([sys.executable, str(script)])
    workers: list[int] = []
    try:
        assert until(lambda: len(list(pids.iterdir())) == 2, 60), "both workers at work"
        workers = [int(path.name) for path in pids.iterdir()]
        assert all(map(lives, workers))
        parent.send_signal(by)
        parent.wait(timeout=10)
        assert until(lambda: not any(map(lives, workers)), 10)
    finally:
        parent.kill()
        for pid in filter(lives, workers):
            os.kill(pid, signal.SIGKILL)


def test_the_second_ctrl_c_leaves_semaphores_that_go_without_a_word() -> None:
    script = """
import os, signal
from rwn.endings import run
from rwn.studies.trials.workers import workers
def command():
    with workers(1):
        for _ in range(2):
            try:
                os.kill(os.getpid(), signal.SIGINT)
            except KeyboardInterrupt:
                pass
run(command)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (130, "rwn: stopped\n")


def test_what_was_cancelled_before_an_end_is_not_told_of() -> None:
    script = """
import time
from rwn.endings import run
from rwn.studies.trials.workers import workers
def command():
    with workers(1) as pool:
        waiting = [pool.submit(time.sleep, 60) for _ in range(5)]
        time.sleep(1)
        assert waiting[-1].cancel()
        stop = pool.shutdown
        pool.shutdown = lambda **options: (time.sleep(0.5), stop(**options))  # its thread sees the ends before
        raise KeyboardInterrupt
run(command)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (130, "rwn: stopped\n")


@pytest.mark.slow
@pytest.mark.parametrize("wait", [0.05, 1.0])  # while its workers start, and while they work
@pytest.mark.parametrize("command", [("trials", "make", "--seed", "7", "--count", "50"), ("thesis", "run", "--all")])
def test_ctrl_c_ends_a_study_soon_with_one_line(tmp_path: Path, command: tuple[str, ...], wait: float) -> None:
    told, out = tmp_path / "told", tmp_path / "out"
    line = [sys.executable, "-m", "rwn", *command, "--out", str(out)]
    with told.open("w") as stream:
        study = subprocess.Popen(line, stderr=stream, stdout=subprocess.DEVNULL, start_new_session=True)
        try:
            assert until(out.exists, 60), "at work"
            time.sleep(wait)
            os.killpg(study.pid, signal.SIGINT)  # as a terminal does it: to the workers too
            assert study.wait(timeout=3) == 130
        finally:
            study.kill()
    assert told.read_text().endswith("rwn: stopped\n")
    assert "Traceback" not in told.read_text()
