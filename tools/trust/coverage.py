"""Lines and branches that the tests reach: `make coverage` (coverage.py) and `make coverage-cpp` (gcovr).

Takes the file that either has written and prints the figures, and for Python the files that lack most branches.
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
    """From `gcovr --json-summary`: lines, functions and branches."""
    found = json.loads(path.read_text())
    kinds = {"line": "lines", "function": "functions", "branch": "branches"}
    rows = [(name, found[f"{kind}_total"], f"{found[f'{kind}_percent'] / 100:.1%}") for kind, name in kinds.items()]
    return [page.table(("of C++", "number", "reached"), rows)]


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("found", type=Path, help="JSON of coverage.py, or with --cpp of gcovr")
    parser.add_argument("--cpp", action="store_true")
    parser.add_argument("--which", default="every test", help="the tests that ran, to be said")
    name = "coverage-cpp" if "--cpp" in sys.argv else "coverage"
    options = page.parsed(parser, name)
    found = of_cpp(options.found) if options.cpp else of_python(options.found)
    page.show(name, options.page, f"Tests: {options.which}.", *found)


if __name__ == "__main__":
    main()
