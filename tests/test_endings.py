"""How a command ends."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import typer

from rwn.endings import NO_RESULT, REFUSED, STOPPED, run
from rwn.errors import InputError, NoResultError


@pytest.fixture(autouse=True)
def _handler_of_pytest() -> Iterator[None]:
    before, passed_over = signal.getsignal(signal.SIGINT), sys.unraisablehook
    yield
    signal.signal(signal.SIGINT, before)
    sys.unraisablehook = passed_over


def _raises(error: BaseException) -> Callable[[], Any]:
    def command() -> None:
        raise error

    return command


def _stopped_and_reworded() -> None:
    try:
        os.kill(os.getpid(), signal.SIGINT)
    except KeyboardInterrupt as error:
        raise InputError("unknown unit 'rad'") from error


@pytest.mark.parametrize(
    ("command", "code", "said"),
    [
        (lambda: None, 0, ""),
        (lambda: NO_RESULT, NO_RESULT, ""),
        (_raises(NoResultError("diverged", "Look.", where="a")), NO_RESULT, "rwn: a: diverged: Look. Nothing was w"),
        (_raises(InputError("no", where="a.csv")), REFUSED, "rwn: a.csv: no\n"),
        (_raises(ValueError("two\nlines")), REFUSED, "rwn: two lines\n"),
        (_raises(FileNotFoundError(2, "No such file", "a")), REFUSED, "rwn: a: No such file; expected a file"),
        (_raises(typer.Abort()), STOPPED, "rwn: stopped\n"),
        (_raises(KeyboardInterrupt()), STOPPED, "rwn: stopped\n"),
        (_stopped_and_reworded, STOPPED, "rwn: stopped\n"),
    ],
)
def test_a_command_ends_with_its_code_and_one_line(
    command: Callable[[], Any], code: int, said: str, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as end:
        run(command)
    assert end.value.code == code
    error = capfd.readouterr().err
    assert error.startswith(said)
    assert error.count("\n") == bool(said)


def test_what_numpy_warns_of_is_not_printed(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        run(lambda: warnings.warn("overflow encountered in square", RuntimeWarning, stacklevel=1))
    assert (end.value.code, capsys.readouterr().err) == (0, "")


def test_a_defect_keeps_its_traceback() -> None:
    with pytest.raises(ZeroDivisionError):
        run(_raises(ZeroDivisionError()))


@pytest.mark.slow
def test_the_second_ctrl_c_ends_what_swallowed_the_first() -> None:
    script = """
import os, signal, time
from rwn.endings import run
def deaf():
    for _ in range(2):
        try:
            os.kill(os.getpid(), signal.SIGINT)
        except KeyboardInterrupt:
            pass
    time.sleep(60)
run(deaf)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=30, check=False)
    assert (done.returncode, done.stderr) == (STOPPED, "rwn: stopped\n")


def test_ctrl_c_is_not_lost_where_python_passes_over_exceptions() -> None:
    """An object that goes, as the locks of imports do: Python says that it ignored the exception, and goes on."""
    script = """
import os, signal, time
from rwn.endings import run
class Going:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
def command():
    going = Going()
    del going
    time.sleep(600)
run(command)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (STOPPED, "rwn: stopped\n")


def test_what_else_python_passes_over_is_said_as_before() -> None:
    script = """
from rwn.endings import run
class Going:
    def __del__(self):
        raise ValueError("no")
run(Going)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0
    assert "ValueError: no" in done.stderr


@pytest.mark.parametrize("rest", ["", "sys.stderr.close(); os.close(2)"])
def test_ctrl_c_while_a_command_ends_after_ctrl_c_changes_nothing(rest: str) -> None:
    script = f"""
import atexit, os, signal, sys
from rwn.endings import run
atexit.register(os.kill, os.getpid(), signal.SIGINT)
def command():
    {rest or "pass"}
    os.kill(os.getpid(), signal.SIGINT)
run(command)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=30, check=False)
    assert (done.returncode, done.stderr) == (STOPPED, "" if rest else "rwn: stopped\n")


LATE = [pytest.param(module, marks=pytest.mark.slow) for module in ("rwn.diagnose", "rwn.cli")]
STARTS = {
    "rwn": 'from rwn_command import main; sys.argv = ["rwn", "effects"]; main()',
    "python -m rwn": 'sys.argv = ["-m", "effects"]; sys.orig_argv = ["python", "-m", "rwn", "effects"]\n'
    'import runpy; runpy.run_module("rwn", run_name="__main__", alter_sys=True)',
}


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("module", ["numpy", "numpy.linalg", *LATE])
def test_ctrl_c_while_rwn_is_imported_is_one_line(module: str, start: str) -> None:
    """An extension whose import is cut short fails as an ImportError that names no Ctrl-C."""
    script = f"""
import os, signal, sys
class Presses:
    def find_spec(self, name, *_):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Presses())
{STARTS[start]}
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (STOPPED, "", "rwn: stopped\n")


def test_whoever_stops_reading_gets_no_traceback() -> None:
    """As with `| head -1`."""
    command = [sys.executable, "-m", "rwn", "effects"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as started:
        assert started.stdout is not None
        assert started.stderr is not None
        started.stdout.close()
        assert started.stderr.read() == ""


@pytest.mark.parametrize("closed", ["stdout", "stderr"])
def test_what_was_closed_before_is_not_written_to(closed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As with `>&-`: Python has None in its place."""
    monkeypatch.setattr(sys, closed, None)
    with pytest.raises(SystemExit) as end:
        run(lambda: print("a", file=getattr(sys, closed)) or getattr(sys, closed).isatty())
    assert end.value.code == 0
    getattr(sys, closed).close()
