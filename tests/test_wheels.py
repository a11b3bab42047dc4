"""What `make wheels` says of wheels, which are made up here: builds take minutes."""

from __future__ import annotations

import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))  # tools are no part of the package

from tools.trust import wheels  # noqa: E402

FILES = {"rwn/__init__.py", "rwn/py.typed"}


def _said(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    *,
    files: tuple[str, ...] = ("1", "1", "2"),
    lacks: str = "",
    answers: tuple[str, ...] = ("a", "a", "a"),
) -> tuple[int, str]:
    """Exit code and text for three builds, each with its content of every file and its answer."""
    content, answer = iter(files), iter(answers)

    def build(_python: str, folder: Path, _commit: str, _settings: list[str]) -> Path:
        text = next(content)
        with zipfile.ZipFile(folder / "rwn.whl", "w") as archive:
            for name in sorted(FILES - {lacks}):
                archive.writestr(zipfile.ZipInfo(name), text)
        return folder / "rwn.whl"

    monkeypatch.setattr(wheels, "build", build)
    monkeypatch.setattr(wheels, "output", lambda *_: "")  # of git, which need not be there
    monkeypatch.setattr(wheels, "committed", lambda _: FILES)
    monkeypatch.setattr(wheels, "installed", lambda *_: ("Python 3", "9", next(answer)))
    monkeypatch.setattr(sys, "argv", ["wheels", "--python", "another"])
    return wheels.main(), capsys.readouterr().out


def test_the_same_bytes_and_answers_are_well(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    code, said = _said(monkeypatch, capsys)
    assert code == 0
    assert "2 of 2 files have the same bytes; the two archives are the same file. 0 committed" in said
    assert said.count("| Python 3 | 9 | a |") == 3


@pytest.mark.parametrize(
    ("wrong", "expected"),
    [
        ({"files": ("1", "2", "2")}, "0 of 2 files have the same bytes: not rwn/__init__.py, rwn/py.typed; the two"),
        ({"lacks": "rwn/py.typed"}, "1 committed files of the packages are missing: rwn/py.typed"),
        ({"answers": ("a", "a", "b")}, "| Python 3 | 9 | b |"),
    ],
)
def test_what_differs_or_lacks_is_said(
    wrong: dict[str, str], expected: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    code, said = _said(monkeypatch, capsys, **wrong)
    assert code == 1
    assert expected in said
