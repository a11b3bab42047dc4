"""Every command that cannot do what it is told ends alike: exit code 2, one line with the remedy, nothing written."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from bad_input import Refuse, csv_text, refused_line
from rwn import cli


def test_existing_output(refuse: Refuse, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "report.html").write_text("mine")
    assert "--overwrite" in refuse(csv_text())
    assert (tmp_path / "out" / "report.html").read_text() == "mine"


def test_a_file_where_the_output_folder_goes(refuse: Refuse, tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    assert "this is a file" in refuse(csv_text())


def test_a_folder_that_takes_no_files(refuse: Refuse, monkeypatch: pytest.MonkeyPatch) -> None:
    def deny(**_: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr("rwn.report.output_files.tempfile.mkdtemp", deny)
    line = refuse(csv_text())
    assert "cannot be written" in line
    assert "choose another --out" in line


def test_a_disk_that_fills_while_writing(refuse: Refuse, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device", "diagnosis.json")

    monkeypatch.setattr("rwn.diagnose", full)
    line = refuse(csv_text())
    assert "diagnosis.json: No space left on device" in line
    assert "; fix: " in line


def test_no_command_shows_the_help(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["rwn"])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    assert "\n  diagnose " in capsys.readouterr().err


def test_an_option_that_is_missing_is_explained(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["rwn", "check", "run.csv"])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    assert "Missing option '--model'; expected the nominal model (TOML); fix: " in capsys.readouterr().err


def test_a_wildcard_in_quotes(refuse: Refuse) -> None:
    line = refuse(csv_text(), extra=("--heldout", "run*.csv"))
    assert "; fix: no file has this name: a shell expands wildcards" in line


def test_judging_by_the_fitted_recording(refuse: Refuse) -> None:
    assert "given twice" in refuse(csv_text(), extra=("--heldout", "TMP/run.csv"))


def test_a_misspelt_profile_is_said_where_it_was_written(refuse: Refuse) -> None:
    line = refuse(csv_text(), extra=("--profile", "odriv"))
    assert "--profile: unknown profile 'odriv'" in line
    assert "did you mean 'odrive'?" in line
    assert "Layout" not in line


def test_two_files_after_one_heldout(refuse: Refuse) -> None:
    line = refuse(csv_text(), extra=("--heldout", "b.csv", "c.csv"))
    assert "'c.csv' follows --heldout b.csv" in line


@pytest.mark.parametrize(
    ("arguments", "held"),
    [
        (["diagnos"], "diagnos"),
        (["diagnose", "a.csv"], "--model"),
        (["diagnose", "a.csv", "--model", "m.toml", "--out", "o", "--seed", "x"], "--seed"),
        (["diagnose", "a.csv", "--model", "m.toml", "--out", "o", "--job", "2"], "--job"),
        (["diagnose", "a.csv", "--model", "m.toml", "--out", "o", "--jobs", "0"], "--jobs"),
        (["effects", "nothing-of-the-kind"], "nothing-of-the-kind"),
    ],
)
def test_wrong_usage(
    arguments: list[str], held: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert held in refused_line(arguments, monkeypatch, capsys)
