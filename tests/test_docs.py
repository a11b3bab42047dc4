"""The documentation holds to the code: its examples run, its links and its module names exist."""

from __future__ import annotations

import contextlib
import importlib
import io
import re
import runpy
from pathlib import Path

import pytest

import rwn
from rwn.model.vocabulary import table

ROOT = Path(__file__).resolve().parents[1]
DEMO = Path(rwn.__file__).parent / "demo"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]


def blocks(page: str) -> list[tuple[str, str]]:
    """Language and text of every fenced block."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


@pytest.mark.slow
def test_the_tutorial_prints_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    scope: dict[str, object] = {}
    told = blocks((ROOT / "docs/tutorial.md").read_text(encoding="utf-8"))
    for (language, code), (after, expected) in zip(told, [*told[1:], ("", "")], strict=True):
        if language != "python":
            continue
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(compile(code, "docs/tutorial.md", "exec"), scope)
        assert out.getvalue() == (expected if after == "text" else ""), code


@pytest.mark.slow
def test_the_readme_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On the demonstration's recordings, with the README's own model file to be read besides."""
    told = blocks((ROOT / "README.md").read_text(encoding="utf-8"))
    (own,) = [text for language, text in told if language == "toml"]
    (code,) = [text for language, text in told if language == "python"]
    (tmp_path / "own.toml").write_text(own)
    assert rwn.read_model(tmp_path / "own.toml").uncertainty
    (tmp_path / "motor.toml").write_text((DEMO / "model.toml").read_text())
    head, *rows = (DEMO / "train.csv").read_text().splitlines(keepends=True)
    half = len(rows) // 2
    for name, part in (("run1", rows[:half]), ("run2", rows[half:])):
        (tmp_path / f"{name}.csv").write_text(head + "".join(part))
    (tmp_path / "run3.csv").write_text((DEMO / "heldout.csv").read_text())
    monkeypatch.chdir(tmp_path)
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(code, "README.md", "exec"), {})
    assert out.getvalue().startswith("The model lacks Coulomb friction of ")
    assert (tmp_path / "result" / "report.html").exists()


def test_the_readme_is_short() -> None:
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 120


def test_the_method_is_two_pages() -> None:
    words = [w for w in (ROOT / "docs/method.md").read_text(encoding="utf-8").split() if re.search("[A-Za-z]{2}", w)]
    assert 500 < len(words) <= 1100


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8")):
        assert target.startswith("http") or (page.parent / target).exists(), target


@pytest.mark.parametrize("page", [p for p in PAGES if p.name != "thesis.md"], ids=lambda page: page.name)
def test_files_that_are_named_exist(page: Path) -> None:
    """`<noun>` stands for any name; a bare file name may lie anywhere."""
    text = page.read_text(encoding="utf-8")
    for name in re.findall(r"`((?:python|cpp|tests|docs|bench|tools)/[\w./]+)", text):
        assert (ROOT / name.rstrip(".")).exists(), name
    for module in re.findall(r"`(rwn(?:\.[a-z_]+)+)\b", text):
        assert _leads_somewhere(module.split(".")), module


def test_the_files_of_a_step_exist() -> None:
    """Headings of docs/method-details.md name a folder, then its files."""
    text = (ROOT / "docs/method-details.md").read_text(encoding="utf-8")
    named = re.findall(r"`(python/rwn/\w+/)`: ((?:`[\w/]+`(?:, )?)+)", text)
    assert len(named) >= 6
    for folder, names in named:
        for name in re.findall(r"`([\w/]+)`", names):
            place = ROOT / folder / name
            assert place.is_dir() or place.with_suffix(".py").exists(), place


def _leads_somewhere(names: list[str]) -> bool:
    """A module, or what a module holds."""
    for count in range(len(names), 0, -1):
        try:
            found = importlib.import_module(".".join(names[:count]))
        except ModuleNotFoundError:
            continue
        return len(names) == count or hasattr(found, names[count])
    return False


def test_every_effect_has_its_page() -> None:
    pages = dict(runpy.run_path(str(ROOT / "tools/effects_pages.py"), run_name="pages")["pages"]())
    for name, effect in table().items():
        page = pages[f"effects/{name}.md"]
        assert effect.equation in page
        assert all(f"`{p.name}`" in page for p in effect.parameters)
        assert f"(effects/{name}.md)" in pages["effects.md"]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_has_every_heading_once(page: Path) -> None:
    headings = re.findall(r"^#+ .*$", page.read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(set(headings)) == sorted(headings)
