"""Lines and branches that the tests reach: `make coverage` (coverage.py) and `make coverage-cpp` (llvm-cov).

Takes the file that either has written and prints the figures, and the files that lack most branches.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

from tools.trust import page

FILES = 12  # that are listed
ELSEWHERE = "rwn/reference/"  # what tests compare with


def of_python(path: Path) -> list[str]:
    """From `coverage json`: the sum over all packages but the reference implementations, by package, and the least."""
    files = {
        name.partition("rwn/")[2]: found["summary"]
        for name, found in json.loads(path.read_text())["files"].items()
        if ELSEWHERE not in name
    }
    rooms: dict[str, list[Any]] = defaultdict(list)
    for name, found in files.items():
        rooms[name.split("/")[0] if "/" in name else "rwn"].append(found)
    rows = [(room, *_shares(found)) for room, found in sorted(rooms.items())]
    rows.append(("all", *_shares(list(files.values()))))
    least = sorted(files.items(), key=lambda item: item[1]["covered_branches"] - item[1]["num_branches"])[:FILES]
    missing = [f"{name} ({f['num_branches'] - f['covered_branches']} of {f['num_branches']})" for name, f in least]
    return [page.table(("package", "lines", "reached", "branches", "reached"), rows),
            f"Most branches are not reached in {', '.join(missing)}."]  # fmt: skip


def _shares(files: list[Any]) -> tuple[int, str, int, str]:
    def total(key: str) -> int:
        return sum(found[key] for found in files)

    lines, branches = total("num_statements"), total("num_branches")
    return (
        lines, f"{total('covered_lines') / max(lines, 1):.1%}",
        branches, f"{total('covered_branches') / max(branches, 1):.1%}",
    )  # fmt: skip


def of_cpp(path: Path) -> list[str]:
    """From `llvm-cov export`: a condition counts twice, as true and as false, however many templates it stands in.

    What the compiler knows beforehand (`if constexpr`) counts as not reached.
    """
    rooms: dict[str, list[list[int]]] = defaultdict(list)
    missed: dict[str, tuple[int, int]] = {}
    for file in json.loads(path.read_text())["data"][0]["files"]:
        name = file["filename"].partition("/cpp/")[2]
        outcomes: dict[tuple[int, ...], list[int]] = defaultdict(lambda: [0, 0])
        for branch in file["branches"]:
            place, times = tuple(branch[:4]), branch[4:6]
            outcomes[place] = [before + now for before, now in zip(outcomes[place], times, strict=True)]
        lines, branches = file["summary"]["lines"], 2 * len(outcomes)
        reached = sum(times > 0 for both in outcomes.values() for times in both)
        missed[name] = branches - reached, branches
        room = name.removeprefix("include/rwn/").removeprefix("src/").split("/")[0]
        rooms[room].append([lines["count"], lines["covered"], branches, reached])
    rooms = dict(sorted(rooms.items()))
    rooms["all"] = [row for rows in rooms.values() for row in rows]
    sums = {room: [sum(column) for column in zip(*rows, strict=True)] for room, rows in rooms.items()}
    table = [
        (room, lines, f"{covered / max(lines, 1):.1%}", branches, f"{reached / max(branches, 1):.1%}")
        for room, (lines, covered, branches, reached) in sums.items()
    ]
    least = sorted(missed.items(), key=lambda item: -item[1][0])[:FILES]
    named = ", ".join(f"{name} ({lost} of {branches})" for name, (lost, branches) in least)
    return [page.table(("part of C++", "lines", "reached", "branches", "reached"), table),
            f"Most branches are not reached in {named}."]  # fmt: skip


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("found", type=Path, help="JSON of coverage.py, or with --cpp of llvm-cov")
    parser.add_argument("--cpp", action="store_true")
    parser.add_argument("--which", default="every test", help="the tests that ran, to be said")
    name = "coverage-cpp" if "--cpp" in sys.argv else "coverage"
    options = page.parsed(parser, name)
    found = of_cpp(options.found) if options.cpp else of_python(options.found)
    page.show(name, options.page, f"Tests: {options.which}.", *found)


if __name__ == "__main__":
    main()
