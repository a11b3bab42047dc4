"""Two that write their results to the same folder at the same time: one is refused, and the other's are whole."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import rwn
from rwn.report.output_files import output_folder

DEMO = Path(rwn.__file__).parent / "demo"


@pytest.mark.parametrize("exists", [True, False])
def test_the_second_is_refused_at_once(exists: bool, tmp_path: Path) -> None:
    out = tmp_path / "a" / "out"
    if exists:
        out.mkdir(parents=True)
        (out / "diagnosis.json").write_text("old")
    with output_folder(out, overwrite=True) as aside:
        with pytest.raises(rwn.InputError, match="out: another rwn is writing its results here"), output_folder(
            out, overwrite=True
        ):
            pytest.fail("two at once")
        (aside / "diagnosis.json").write_text("new")
    assert [path.name for path in out.iterdir()] == ["diagnosis.json"]
    assert (out / "diagnosis.json").read_text() == "new"
    with output_folder(out, overwrite=True):
        pass  # the first has let go of it


def test_a_folder_that_was_made_for_results_goes_with_them(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no result"), output_folder(tmp_path / "a" / "b"):
        raise ValueError("no result")
    assert not any(tmp_path.iterdir())
    (tmp_path / "mine").mkdir()
    with pytest.raises(ValueError, match="no result"), output_folder(tmp_path / "mine"):
        raise ValueError("no result")
    assert (tmp_path / "mine").is_dir()


@pytest.mark.slow
def test_two_diagnoses_into_one_folder(tmp_path: Path) -> None:
    run = rwn.read_recording(DEMO / "train.csv").beginning(400)
    rwn.save(run, tmp_path / "a.csv")
    command = [sys.executable, "-m", "rwn", "diagnose", "a.csv", "--model", str(DEMO / "model.toml"), "--out", "R",
               "--overwrite", "--effort", "0.1", "--jobs", "1"]  # fmt: skip
    started = [subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    said = [one.communicate(timeout=240)[1] for one in started]
    codes = [one.returncode for one in started]
    assert sorted(codes) in ([0, 2], [0, 0]), said  # both: where one ended before the other had begun
    for code, text in zip(codes, said, strict=True):
        assert code == 0 or ("another rwn is writing" in text and text.count("\n") == 1)
    assert rwn.Diagnosis.load(tmp_path / "R").sources[1].path.endswith("a.csv")
    assert not list(tmp_path.glob("**/.rwn-*"))
