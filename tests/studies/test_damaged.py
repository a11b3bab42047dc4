"""Damaged files of trials: one line that names the file."""

from __future__ import annotations

import gzip
import hashlib
import json
import os
import zlib
from pathlib import Path

import pytest

from rwn.errors import InputError
from rwn.studies.thesis import cli as thesis
from rwn.studies.trials.damaged import reading
from rwn.studies.trials.grade import load_answers
from rwn.studies.trials.seal import ANSWERS, HASH


@pytest.mark.parametrize("error", [KeyError("verdict"), TypeError("x"), ValueError("x"), EOFError("x"), zlib.error()])
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


@pytest.mark.parametrize("cut", [0, 5, 20, -1])
def test_a_truncated_seal_with_its_hash_is_named(cut: int, tmp_path: Path) -> None:
    packed = gzip.compress(json.dumps({"answers": {"a": {}}}).encode() * 50, mtime=0)[:cut]
    (tmp_path / ANSWERS).write_bytes(packed)
    (tmp_path / HASH).write_text(f"{hashlib.sha256(packed).hexdigest()}  {ANSWERS}\n")
    with pytest.raises(InputError, match=ANSWERS):
        load_answers(tmp_path)


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
