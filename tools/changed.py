"""The tests of what changed: of the files that are not committed, else of the last commit; `make check` runs these.

A file of a room (python/rwn/fit, cpp/src/fit) has the tests of that room, a file at the top those of its name, a test
itself. Those of the walls and of docstrings belong to all.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ALWAYS = ("tests/test_walls.py", "tests/test_docstrings.py")
OF_TEXT = ("tests/test_docs.py", "tests/test_walks.py")
OF_TOOLS = tuple(f"tests/test_{of}.py" for of in ("aside", "changed", "fuzz_corpus", "kills_and_soak", "testing_page"))
NO_MODULES = ("__init__.py", "__main__.py")


def changed() -> list[str]:
    """The files that differ from the last commit, or that it changed where none does."""
    now = _git("status", "--porcelain", "--no-renames", "--untracked-files=all")
    files = [line[3:].strip('"') for line in now]
    return files or _git("diff", "--name-only", "HEAD~1")


def paths_for(files: Iterable[str]) -> list[str]:
    """The tests of changed files, those that exist, each once."""
    found = dict.fromkeys(path for file in files for path in _for(Path(file)))
    return [path for path in (*ALWAYS, *found) if (ROOT / path).exists()]


def _for(file: Path) -> list[str]:
    parts = file.parts
    if file.suffix == ".md":
        return list(OF_TEXT)
    if parts[0] == "tools":
        return list(OF_TOOLS)
    if parts[0] == "tests":
        if file.name.startswith("test_"):
            return [str(file)]
        return _importing(file)
    room = next((part for part in parts[1:-1] if (ROOT / "tests" / part).is_dir()), "")
    if room:
        return [f"tests/{room}"]
    if "reference" in parts:  # which the networks are compared with
        return ["tests/networks"]
    found = [str(path.relative_to(ROOT)) for path in (ROOT / "tests").glob(f"test_*{file.stem}*.py")]
    return found or (["tests"] if file.suffix in (".py", ".cpp") and file.name not in NO_MODULES else [])


def _importing(helper: Path) -> list[str]:
    """Tests that import a helper of theirs, as tests/made_up.py."""
    said = f"import {helper.stem}\n", f"from {helper.stem} import"
    tests = ((path, path.read_text(encoding="utf-8")) for path in sorted((ROOT / "tests").rglob("test_*.py")))
    return [str(path.relative_to(ROOT)) for path, text in tests if any(words in text for words in said)]


def _git(*arguments: str) -> list[str]:
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


if __name__ == "__main__":
    print(*paths_for(changed()))
