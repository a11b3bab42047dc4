"""Mutation score of readers and of the code that decides: `make mutants-python COUNT=100` (operators of cosmic-ray).

Alters one place of one file at a time, in a copy, and runs the tests named for that file; a mutant that no test kills
is listed. Mutants are drawn at random with --seed from all that the operators give. Each runs in a process forked from
one that has loaded what the tests need but rwn itself.
"""

from __future__ import annotations

import argparse
import io
import os
import random
import resource
import shutil
import signal
import sys
import sysconfig
from collections import Counter
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.trust.aside import folder_aside
from tools.trust.stopping import until_stopped

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 60  # of processor time: what takes longer was altered into a loop without end
FORMATS, RECORDING = "python/rwn/recording/formats/", "python/rwn/recording/"
# file -> the tests that are to notice
FILES = {
    f"{FORMATS}csv.py": ("tests/recording/test_csv_rows.py", "tests/recording/test_csv.py",
                         "tests/recording/test_csv_instants.py"),
    f"{FORMATS}csv_cells.py": ("tests/recording/test_csv_dialect.py", "tests/recording/test_csv.py"),
    f"{FORMATS}csv_dialect.py": ("tests/recording/test_csv_dialect.py", "tests/recording/test_csv_preamble.py",
                                 "tests/recording/test_csv.py"),
    f"{FORMATS}scope.py": ("tests/recording/test_scope.py", "tests/recording/test_profiles.py"),
    f"{FORMATS}wpilog.py": ("tests/recording/test_wpilog.py",),
    f"{FORMATS}channels.py": ("tests/recording/test_table.py", "tests/recording/test_wpilog.py"),
    f"{FORMATS}sysid.py": ("tests/recording/test_logs.py",),
    f"{FORMATS}part.py": ("tests/recording/test_logs.py",),
    f"{RECORDING}profiles/__init__.py": ("tests/recording/test_profiles.py",),
    f"{FORMATS}table.py": ("tests/recording/test_table.py", "tests/recording/test_formats.py"),
    f"{FORMATS}nested.py": ("tests/recording/test_table.py", "tests/recording/test_formats.py"),
    f"{FORMATS}npz.py": ("tests/recording/test_formats.py", "tests/recording/test_converted.py"),
    f"{FORMATS}frame.py": ("tests/recording/test_frame.py", "tests/recording/test_formats.py"),
    f"{RECORDING}columns.py": ("tests/recording/test_columns.py", "tests/recording/test_missing_units.py",
                               "tests/recording/test_profiles.py", "tests/recording/test_recording.py"),
    f"{RECORDING}units.py": ("tests/recording/test_units.py", "tests/recording/test_missing_units.py"),
    f"{RECORDING}copies.py": ("tests/recording/test_copies.py", "tests/recording/test_rows_in_common.py"),
    f"{RECORDING}selection.py": ("tests/recording/test_selection.py",),
    "python/rwn/model/toml_reader.py": ("tests/model/test_recording_table.py", "tests/model/test_bad_models.py"),
    "python/rwn/model/formula.py": ("tests/model/test_formula.py", "tests/model/test_own_effects.py"),
    "python/rwn/decide/account.py": ("tests/decide/test_account_by_hand.py", "tests/decide/test_calibration.py"),
    "python/rwn/decide/verdict.py": ("tests/decide/test_verdict.py",),
    "python/rwn/decide/calibration.py": ("tests/decide/test_calibration.py",),
    "python/rwn/decide/excitation.py": ("tests/decide/test_excitation.py",),
}  # fmt: skip
# A | of types is not looked at when the code runs.
_IDLE = ("core/ReplaceBinaryOperator_BitOr_", "core/VariableInserter", "core/VariableReplacer")  # the last: need names
# Whether numbers are identical is left open by Python: of small ones it is whether they are equal.
_IDENTITY = ("_Is", "_IsNot")


@dataclass(frozen=True)
class Mutant:
    """One change of one file."""

    path: str
    operator: str
    occurrence: int


def mutants(paths: list[str]) -> Iterator[Mutant]:
    """All that cosmic-ray's operators make of the files."""
    from cosmic_ray.ast import get_ast_from_path
    from cosmic_ray.plugins import get_operator, operator_names

    for path in paths:
        tree = get_ast_from_path(ROOT / path)
        for name in sorted(operator_names()):
            if name.startswith(_IDLE) or name.endswith(_IDENTITY):
                continue
            operator = get_operator(name)()
            places = [node for node in _nodes(tree) for _ in operator.mutation_positions(node)]
            yield from (Mutant(path, name, k) for k, node in enumerate(places) if not _begins_keywords(node))


def _begins_keywords(node: Any) -> bool:
    """Whether it is the * of a signature, which the operators take for a product: what they make of it is no Python."""
    return getattr(node, "value", "") == "*" and node.parent.type in ("parameters", "param", "typedargslist")


def _nodes(node: Any) -> Iterator[Any]:
    yield node
    for child in getattr(node, "children", ()):
        yield from _nodes(child)


def killed(mutant: Mutant, copy: Path) -> bool:
    """Whether a test fails, in a process of its own with the altered file."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    source = (ROOT / mutant.path).read_text()
    altered = mutate_code(source, get_operator(mutant.operator)(), mutant.occurrence)
    if altered is None:
        return True
    (copy / mutant.path).write_text(altered)
    passes = _pass(FILES[mutant.path], copy)
    (copy / mutant.path).write_text(source)
    return not passes


def _pass(tests: tuple[str, ...], copy: Path) -> bool:
    child = os.fork()
    if child == 0:
        _test(tests, copy)
    try:
        _, status = os.waitpid(child, 0)
    except KeyboardInterrupt:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        raise
    return os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0


def _test(tests: tuple[str, ...], copy: Path) -> None:
    """In the child: never returns."""
    import pytest

    code = 1
    try:
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        os.chdir(copy)
        sys.path.insert(0, str(copy / "python"))
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            code = int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", "-m", "not slow", "--no-header", *tests]))
    finally:
        os._exit(code)


def main() -> int:
    """Prints the score and the survivors; 1 below --least."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100, help="mutants, drawn at random")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--least", type=float, default=0.85)
    parser.add_argument("--only", help="files whose path holds this")
    parser.add_argument("--page", type=Path, help="page whose section 'mutants-python' is written anew")
    options = parser.parse_args()
    paths = [path for path in FILES if options.only is None or options.only in path]
    every = list(mutants(paths))
    drawn = random.Random(options.seed).sample(every, min(options.count, len(every)))
    for module in ("numpy", "scipy.io", "pint", "msgspec", "typer", "pytest", "narwhals.stable.v1"):
        __import__(module)
    with folder_aside("mutants") as copy:
        for part in ("python", "tests", "pyproject.toml", "tools"):
            whole = ROOT / part
            shutil.copytree(whole, copy / part) if whole.is_dir() else shutil.copy(whole, copy / part)
        installed = Path(sysconfig.get_paths()["platlib"])
        for compiled in installed.glob("rwn/**/*.so"):  # a clean clone has none beside its sources
            shutil.copy(compiled, copy / "python" / compiled.relative_to(installed))
        for tests in {FILES[mutant.path] for mutant in drawn}:
            if not _pass(tests, copy):
                print(f"{', '.join(tests)} fail on what is not altered: no score", file=sys.stderr)
                return 2
        tried, survivors = list[Mutant](), list[Mutant]()
        with until_stopped():
            for mutant in drawn:
                if not killed(mutant, copy):
                    survivors.append(mutant)
                    print("survives:", *said(mutant), flush=True)
                tried.append(mutant)
                print(f"{len(tried)}/{len(drawn)}", end="\r", file=sys.stderr)
    show(tried, survivors, len(every), options)
    return 0 if len(tried) - len(survivors) >= options.least * len(tried) else 1


def said(mutant: Mutant) -> tuple[str, str, str]:
    """Where a mutant is, what it is, and its line."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    before = (ROOT / mutant.path).read_text().splitlines()
    after = mutate_code("\n".join(before) + "\n", get_operator(mutant.operator)(), mutant.occurrence) or ""
    pairs = zip(before, after.splitlines(), strict=False)
    at, line = next(((k, b) for k, (a, b) in enumerate(pairs, 1) if a != b), (0, ""))
    where = f"{mutant.path.removeprefix('python/rwn/')}:{at}"
    return where, mutant.operator.removeprefix("core/"), f"`{line.strip()}`".replace("|", "\\|")


def show(tried: list[Mutant], survivors: list[Mutant], every: int, options: argparse.Namespace) -> None:
    """The score by file, and the survivors; rwn is loaded here, after the last test has run."""
    from tools.trust import page

    each, left = Counter(m.path for m in tried), Counter(m.path for m in survivors)
    rows = [(path.removeprefix("python/rwn/"), n, n - left[path]) for path, n in sorted(each.items())]
    rows.append((f"all (of {every} possible)", len(tried), len(tried) - len(survivors)))
    scored = page.table(("file", "tried", "killed"), rows)
    early = f"; stopped after {len(tried)} of {options.count}, in the order in which they were drawn"
    stopped = early if len(tried) < min(options.count, every) else ""
    parts = [f"{1 - len(survivors) / max(len(tried), 1):.0%} killed, seed {options.seed}{stopped}.", scored]
    if survivors:
        parts.append(page.table(("survivor", "operator", "altered line"), sorted(map(said, survivors))))
    page.show("mutants-python", options.page, *parts)


if __name__ == "__main__":
    sys.exit(main())
