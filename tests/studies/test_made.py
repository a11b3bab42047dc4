from __future__ import annotations

import subprocess
from pathlib import Path

from rwn.studies import made


def test_a_result_of_a_changed_tree_says_so(tmp_path: Path) -> None:
    """In a repository of the same layout: the commit, and + once a source is changed."""
    here, kernel, page = (tmp_path / name for name in ("python/rwn/studies/made.py", "cpp/kernel.cpp", "docs/page.md"))
    test = tmp_path / "tests/test_kernel.py"
    for path in (here, kernel, page, test):
        path.parent.mkdir(parents=True)
        path.write_text("first\n")

    def git(*words: str) -> str:
        who = ["-c", "user.name=a", "-c", "user.email=a@b"]
        return subprocess.run(["git", *who, *words], cwd=tmp_path, check=True, capture_output=True, text=True).stdout

    git("init", "-q")
    git("add", ".")
    git("commit", "-q", "-m", "first")
    head = git("rev-parse", "--short", "HEAD").strip()
    assert made._commit(here) == head
    test.write_text("second\n")
    assert made._commit(here) == head, "no test changes a result of the package"
    assert made._commit(here, (*made.PACKAGE, *made.TESTS)) == f"{head}+"
    page.write_text("second\n")
    assert made._commit(here) == head, "a page is no source"
    kernel.write_text("second\n")
    assert made._commit(here) == f"{head}+"
