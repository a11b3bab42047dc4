"""Damaged files of trials: one line that names the file."""

from __future__ import annotations

import gzip
import hashlib
import json
import math
import os
import zlib
from pathlib import Path

import pytest

from command_line import Run
from rwn.errors import InputError
from rwn.studies.thesis import cli as thesis
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.grade import grade_folder, load_answers
from rwn.studies.trials.said import said_in, timing_of
from rwn.studies.trials.seal import ANSWERS, HASH, seal
from rwn.studies.trials.trial_files import read_speed

RAISED = [KeyError("verdict"), TypeError("x"), ValueError("x"), EOFError("x"), zlib.error(), RecursionError("x")]


@pytest.mark.parametrize("error", RAISED)
def test_what_a_damaged_file_raises_is_one_line_with_its_name(error: Exception, tmp_path: Path) -> None:
    said = r"diagnosis\.json: this cannot be read.*fix: "
    with pytest.raises(InputError, match=said), reading(tmp_path / "diagnosis.json"):
        raise error


def test_a_clear_refusal_is_left_as_it_is(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"^mine$"), reading(tmp_path):
        raise InputError("mine")


@pytest.mark.parametrize("content", [b"", b"{", b"\xb8\xff"])
def test_damaged_answers_are_named(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "trial").mkdir()
    (tmp_path / "trial" / "answer.json").write_bytes(content)
    with pytest.raises(InputError, match=r"answer\.json"):
        load_answers(tmp_path)


@pytest.mark.parametrize("left", ["a folder without its model", "nothing", "a file"])
def test_a_trial_that_the_seal_holds_and_that_is_gone_is_named(left: str, tmp_path: Path) -> None:
    for name in ("trial_1", "trial_2"):
        (tmp_path / name).mkdir()
    (tmp_path / "trial_1" / "model.toml").write_text("")
    seal(tmp_path, {"answers": {"trial_1": {}, "trial_2": {}}})
    if left != "a folder without its model":
        (tmp_path / "trial_2").rmdir()
    if left == "a file":
        (tmp_path / "trial_2").write_text("")
    with pytest.raises(InputError, match=r"trial_2: the answers hold this trial"):
        grade_folder(tmp_path)


@pytest.mark.parametrize("cut", [0, 5, 20, -1])
def test_a_truncated_seal_with_its_hash_is_named(cut: int, tmp_path: Path) -> None:
    packed = gzip.compress(json.dumps({"answers": {"a": {}}}).encode() * 50, mtime=0)[:cut]
    (tmp_path / ANSWERS).write_bytes(packed)
    (tmp_path / HASH).write_text(f"{hashlib.sha256(packed).hexdigest()}  {ANSWERS}\n")
    with pytest.raises(InputError, match=ANSWERS):
        load_answers(tmp_path)


@pytest.mark.parametrize(
    ("content", "what"),
    [(None, "this file is missing"), (b"", "this is empty"), (b" \n", "this is empty"), (b"\xff", "this cannot be")],
)
def test_a_hash_that_is_no_hash_is_named_itself(
    content: bytes | None, what: str, run: Run, tmp_path: Path
) -> None:
    seal(tmp_path, {"answers": {"a": {}}})
    (tmp_path / HASH).unlink()
    if content is not None:
        (tmp_path / HASH).write_bytes(content)
    code, out, said = run("trials", "score", str(tmp_path))
    (line,) = said.splitlines()
    assert (code, out) == (2, "")
    assert line.startswith(f"rwn: {tmp_path / HASH}: {what}")
    assert "; expected " in line
    assert "; fix: " in line


def test_a_page_without_matplotlib_is_refused_before_the_experiments(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    with pytest.raises(InputError, match=r"pip install 'rwn\[thesis\]'"):
        thesis._run([], Path(), count="quick", seeds=1, jobs=1, page=Path("a.md"))


def test_a_page_that_is_a_folder_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    with pytest.raises(InputError, match="this is a folder"):
        thesis.table_20(page=tmp_path)


def test_a_pipe_is_refused_before_it_is_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "answer.json")
    said = r"answer\.json: this is not a regular file"
    with pytest.raises(InputError, match=said), reading(tmp_path / "answer.json"):
        pytest.fail("it would wait for ever")


def test_a_file_that_the_system_refuses_says_so_itself(tmp_path: Path) -> None:
    """The command line words these: no such file, permission denied."""
    with pytest.raises(FileNotFoundError), reading(tmp_path):
        (tmp_path / "nowhere.json").read_text()
    with pytest.raises(InputError, match="this cannot be read"), reading(tmp_path):
        raise OSError("a damaged archive")


def _named(**of_parameter: object) -> dict[str, object]:
    gap = {"value": 1.0, "unit": "rad", **of_parameter}
    return {"name": "backlash", "equation": "mechanical", "parameters": {"gap": gap}}


SAID = {"verdict": "missing-physics", "effects": [{"name": "backlash", "equation": "mechanical"}]}


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"verdict": "foo"}, "verdict"),
        ({"account": 5}, "account"),
        ({"account": [{"effects": "a"}]}, r"account\[0\]"),
        ({"account": [{"name": "backlash", "probability": "often"}]}, r"account\[0\].probability"),
        ({"heldout": None}, "heldout"),
        ({"heldout": [{"recording": "a.csv"}]}, r"heldout\[0\]"),
        ({"format": 99}, "format"),
        ({"effects": [{"name": "backlash"}]}, r"effects\[0\]"),
        ({"effects": [{"name": "backlash", "equation": "mechanical", "probability": 3}]}, r"effects\[0\].probability"),
        ({"set": "backlash"}, "set"),
        ({"verdict": "adequate"}, "effects"),
        ({"effects": [_named(interval=(2.0, 1.0))]}, r"effects\[0\].parameters.gap.interval"),
        ({"adequate_probability": -0.1}, "adequate_probability"),
        ({"effects": [{"name": "time-shift", "equation": "recording"}]}, "beneath"),
    ],
)
def test_a_diagnosis_of_other_fields_is_refused_by_file_and_field(
    changes: dict[str, object], field: str, tmp_path: Path
) -> None:
    path = tmp_path / "diagnosis.json"
    path.write_text(json.dumps(SAID))
    assert said_in(path) == SAID
    path.write_text(json.dumps(SAID | changes))
    with pytest.raises(InputError, match=rf"diagnosis\.json: {field}: "):
        said_in(path)


@pytest.mark.parametrize("left", ["a loop", "a link to nothing", "a file"])
def test_a_diagnosis_that_cannot_be_reached_is_damage(left: str, tmp_path: Path) -> None:
    trial, out = tmp_path / "trial_1", tmp_path / "trial_1" / "out"
    trial.mkdir()
    (trial / "model.toml").write_text("")
    (trial / "answer.json").write_text(json.dumps({"verdict": "adequate", "effects": []}))
    if left == "a file":
        out.write_text("x")
    else:
        out.mkdir()
        (out / "diagnosis.json").symlink_to("diagnosis.json" if left == "a loop" else "nothing")
    said = r"out: this is no folder" if left == "a file" else r"diagnosis\.json"
    with pytest.raises((InputError, OSError), match=said):
        grade_folder(tmp_path)


def test_a_number_that_json_does_not_have_is_read_as_one(tmp_path: Path) -> None:
    interval = {"value": 1.0, "unit": "s", "interval": [0.5, "inf"]}
    said = SAID | {"effects": [{"name": "a", "equation": "mechanical", "parameters": {"lag": interval}}]}
    (tmp_path / "diagnosis.json").write_text(json.dumps(said))
    effects = said_in(tmp_path / "diagnosis.json")["effects"]
    assert list(effects[0]["parameters"]["lag"]["interval"]) == [0.5, math.inf]


@pytest.mark.parametrize(
    ("content", "said"),
    [('{"seconds": "x"}', "seconds: "), ('"x"', "expected 'object'"), ('{"seconds": -1}', "seconds: ")],
)
def test_a_timing_of_other_fields_is_refused_by_file_and_field(content: str, said: str, tmp_path: Path) -> None:
    assert timing_of(tmp_path).seconds is None
    (tmp_path / "timing.json").write_text(content)
    with pytest.raises(InputError, match=rf"timing\.json: {said}"):
        timing_of(tmp_path)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("garbage", "there are no rows"),
        ("", "there are no rows"),
        ("time [s],speed [rad/s]\n", "there are no rows"),
        ("time [s],a\n1,2\n3,4\n", "there is no column speed"),
        ("time [s],speed [rad/s]\n1,2\n", "1 rows; its held-out recording has 2"),
        ("time [s],speed [rad/s]\n1,2\n2,nan\n", "a speed is not a finite number"),
        ("a,b\nc,d\n", "this cannot be read"),
    ],
)
def test_a_simulated_recording_of_garbage_is_one_line(content: str, said: str, tmp_path: Path) -> None:
    """Warnings are errors here: on the terminal they would be lines of their own."""
    (tmp_path / "simulated.csv").write_text(content)
    with pytest.raises(InputError, match=rf"simulated\.csv: {said}"):
        read_speed(tmp_path / "simulated.csv", rows=2)


def test_an_open_answer_that_is_no_table_is_named(tmp_path: Path) -> None:
    (tmp_path / "trial").mkdir()
    (tmp_path / "trial" / "answer.json").write_text("5")
    with pytest.raises(InputError, match=r"answer\.json"):
        load_answers(tmp_path)
