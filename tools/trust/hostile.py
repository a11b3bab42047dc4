"""Runs hostile inputs through the command line and counts how they end, by class: `make hostile`.

Each case runs in a process of its own, forked from one that has loaded rwn, within limits of time and memory. Exit
code 1 where any ended in a traceback, a crash, a hang, an unclear line, or a result that it should not have.
"""

from __future__ import annotations

import argparse
import importlib
import io
import os
import resource
import shutil
import signal
import sys
import warnings
from collections import Counter, defaultdict
from collections.abc import Iterable
from contextlib import redirect_stdout, suppress
from pathlib import Path

import numpy as np

from rwn import cli
from tools.trust import page
from tools.trust.aside import folder_aside
from tools.trust.cases import Case, cases
from tools.trust.good_files import write_formats, write_recordings, write_results

ENDS = ("clear line", "no result, said", "accepted", "unclear line", "traceback", "crash", "hang", "nonsense accepted")
GOOD = ENDS[:3]
LIBRARIES = (
    "scipy.signal", "scipy.optimize", "scipy.io", "matio", "pyarrow.parquet", "python_calamine", "mcap_ros2.decoder",
    "nptdms", "asammdf",
)  # fmt: skip
SECONDS, WAITED, BYTES = 30, 300, 3 * 2**30  # of processor time, of waiting, of memory


def ended(case: Case, base: Path) -> tuple[str, str]:
    """How a case ends, and what it said; `base` holds the good files, which are copied."""
    with folder_aside("hostile") as folder:
        for path in base.iterdir():
            if path.is_file():
                shutil.copy(path, folder)
            elif path.name in case.command:
                shutil.copytree(path, folder / path.name)
        _place(case, folder)
        said = folder.parent / f"{folder.name}.said"
        child = os.fork()
        if child == 0:
            _run(case, folder, said)
        _, status = os.waitpid(child, 0)
        text = said.read_text(errors="replace") if said.exists() else ""
        said.unlink(missing_ok=True)
        return _class(case, folder, status, text), text


def load(base: Path) -> None:
    """A good run, before the processes are forked: what every command loads once is no part of a case."""
    for module in ("thesis.cli", "thesis.registry", "trials.cli", "trials.make", "trials.grade", "machines.registry"):
        importlib.import_module(f"rwn.studies.{module}")
    for module in LIBRARIES:
        with suppress(ImportError), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            importlib.import_module(module)
    with folder_aside("hostile") as name, redirect_stdout(io.StringIO()):
        model, recording = str(base / "motor.toml"), str(base / "a.csv")
        cli.app(["simulate", model, "--input", recording, "--out", f"{name}/out.csv"], standalone_mode=False)


def _place(case: Case, folder: Path) -> None:
    for name, content in case.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    for name, to in case.links.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).unlink(missing_ok=True)
        if to == "|":
            os.mkfifo(folder / name)
        else:
            (folder / name).symlink_to(to)


def _run(case: Case, folder: Path, said: Path) -> None:
    """In the child: never returns."""
    code = 70
    try:
        signal.alarm(WAITED)
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        with said.open("wb") as file:
            os.dup2(file.fileno(), 2)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.chdir(folder)
        sys.argv = ["rwn", *case.command]
        sys.stderr = open(2, "w", buffering=1, errors="replace", closefd=False)  # noqa: SIM115
        try:
            cli.main()
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
        except BaseException:
            import traceback

            traceback.print_exc()
            code = 1
        sys.stderr.flush()
    finally:
        os._exit(code)


def _class(case: Case, folder: Path, status: int, text: str) -> str:
    lines = [line for line in text.splitlines() if line.strip()]
    if os.WIFSIGNALED(status):
        return "hang" if os.WTERMSIG(status) in (signal.SIGALRM, signal.SIGXCPU) else "crash"
    code = os.WEXITSTATUS(status)
    if "Traceback" in text or "Exception ignored" in text or code not in (0, 2, 3):
        scored = case.command[:2] == ("trials", "score") and code == 1 and "Traceback" not in text
        return "accepted" if scored else "traceback"  # score ends with 1 where a target is missed
    if code == 0:
        return "nonsense accepted" if case.refuse or not _finite(folder / "out.csv") else "accepted"
    said = [line for line in lines if line.startswith("rwn: ")]
    one = len(said) == 1 and lines[-1] == said[0] and said[0].isprintable() and len(said[0]) < 4100
    return "unclear line" if not one else "clear line" if code == 2 else "no result, said"


def _finite(out: Path) -> bool:
    return not out.is_file() or bool(np.isfinite(np.loadtxt(out, delimiter=",", skiprows=1)).all())


def table(found: dict[str, Counter[str]]) -> str:
    """Counts by class of input and how it ended, as Markdown."""
    counted = [*sorted(found.items()), ("all", sum(found.values(), Counter[str]()))]
    return page.table(("class", "cases", *ENDS), [[k, sum(n.values()), *(n[end] for end in ENDS)] for k, n in counted])


def count(all_cases: Iterable[Case], base: Path, *, show: bool = True) -> tuple[dict[str, Counter[str]], list[str]]:
    """Counts by class, and a line for each case that did not end well."""
    found: dict[str, Counter[str]] = defaultdict(Counter)
    bad = []
    load(base)
    for k, case in enumerate(all_cases):
        if show and k % 100 == 0:
            print(f"{k} cases", file=sys.stderr, flush=True)
        end, text = ended(case, base)
        found[case.kind][end] += 1
        if end not in GOOD:
            last = (text.strip().splitlines() or [""])[-1]
            bad.append(f"{end}: {case.kind}: {case.what}: {last[:200]!r}")
            if show:
                print(bad[-1], file=sys.stderr, flush=True)
    return found, bad


def main() -> int:
    """Prints the table; 1 where a case did not end well."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--damaged", type=int, default=1500, help="damaged files beside the table of cases")
    parser.add_argument("--seed", type=int, default=0)
    options = page.parsed(parser, "hostile")
    with folder_aside("hostile") as aside:
        base, good = aside / "base", aside / "good"
        write_recordings(base)
        if options.damaged:
            write_formats(good)
            write_results(good)
            for folder in ("result", "trials"):
                shutil.copytree(good / folder, base / folder)
        found, bad = count(cases(options.damaged, options.seed, good), base)
    page.show("hostile", options.page, table(found), *bad)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
