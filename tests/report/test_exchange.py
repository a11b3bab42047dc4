"""A result gives way to another as one: whenever a process is stopped, who reads has the files of one."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import made_up
import rwn
from rwn.errors import InputError
from rwn.report.diagnosis import Diagnosis
from rwn.report.output_files import check_folder, output_folder

DEMO = Path(rwn.__file__).parent / "demo"
STOPPED = 9
CHANGES = ("os.rename", "os.mkdir", "os.rmdir", "os.remove")
Files = dict[str, bytes]

with_model, without, later = (
    replace(made(), curves=made().curves[:1], corrected=corrected)
    for made, corrected in (
        (made_up.found, rwn.read_model(DEMO / "model.toml")), (made_up.adequate, None), (made_up.unexplained, None),
    )
)  # fmt: skip
ways = pytest.mark.parametrize(
    ("old", "new"), [(with_model, without), (without, with_model), (None, with_model)], ids=["less", "more", "first"]
)
forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="the process that is stopped is forked")


def _files(folder: Path) -> Files:
    """What a reader sees: no hidden names, and not what the user keeps there."""
    paths = folder.glob("[!.]*") if folder.is_dir() else ()
    return {path.name: path.read_bytes() for path in paths if path.name != "notes"}


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Diagnosis | None], Files]:
    """Those of a result."""
    made: dict[int, Files] = {id(None): {}}
    for found in (with_model, without, later):
        folder = tmp_path_factory.mktemp("result")
        found.save(folder)
        made[id(found)] = _files(folder) | {"report.html": found.verdict.encode()}  # in short: it is not read back
    return lambda found: made[id(found)]


def _save(new: Files, out: Path) -> None:
    """As `Diagnosis.save`, which computes them."""
    with output_folder(out, overwrite=True) as aside:
        for name, content in new.items():
            (aside / name).write_bytes(content)


@pytest.fixture
def place(tmp_path: Path) -> Iterator[Callable[[Files], Path]]:
    """A new place for a result, with a result and a folder of the user's own in it unless it is the first one."""
    count = iter(range(1000))

    def make(old: Files) -> Path:
        out = tmp_path / str(next(count)) / "out"
        out.parent.mkdir()
        if old:
            _save(old, out)
            (out / "notes").mkdir()
            (out / "notes" / "mine.txt").write_text("mine")
        return out

    yield make
    for mine in tmp_path.glob("*/out/notes"):
        assert (mine / "mine.txt").read_text() == "mine"


def _stopped_before(change: int, new: Files, out: Path) -> bool:
    """Whether saving ended, in a process that is no more before its change of that number."""
    child = os.fork()
    if child == 0:
        left = iter(range(change))

        def hear(event: str, _: object) -> None:
            if event in CHANGES and next(left, None) is None:
                os._exit(STOPPED)

        try:
            sys.addaudithook(hear)
            _save(new, out)
            os._exit(0)
        finally:
            os._exit(70)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    assert code in (0, STOPPED)
    return code == 0


def _loaded(out: Path) -> tuple[Diagnosis | None, str]:
    try:
        return Diagnosis.load(out), ""
    except InputError as error:
        return None, str(error)


@pytest.mark.slow
@forks
@ways
def test_a_process_that_is_stopped_before_any_change_leaves_no_mixture(
    old: Diagnosis | None, new: Diagnosis, place: Callable[[Files], Path], files: Callable[[Diagnosis | None], Files]
) -> None:
    before, after, seen, change, ended = files(old), files(new), set(), 0, False
    while not ended:
        out = place(before)
        ended = _stopped_before(change, after, out)
        change += 1
        there = _files(out)
        assert there.items() <= before.items() or there.items() <= after.items()
        found, refused = _loaded(out)
        if found is not None:
            assert there == (after if found == new else before)
        elif old is not None:
            assert "when a process was killed" in refused
        assert "\n" not in refused
        seen.add("refused" if found is None else "new" if found == new else "old")
        check_folder(out)
        assert _files(out) in (before, after)
        assert not list(out.parent.rglob(".rwn-*"))
    assert change > 15
    assert seen == ({"new", "refused"} if old is None else {"old", "new", "refused"})
    assert _files(out) == after


def _raising(monkeypatch: pytest.MonkeyPatch, at: int, stop: str) -> None:
    """A move fails, the one after `at` others, and those after it do not."""
    count, move = iter(range(1000)), os.replace

    def fail(source: Any, target: Any) -> None:
        if next(count) == at:
            full = OSError(errno.ENOSPC, "No space left on device", str(source), None, str(target))
            raise full if stop == "full disk" else KeyboardInterrupt
        move(source, target)

    monkeypatch.setattr(os, "replace", fail)


@ways
@pytest.mark.parametrize("stop", ["full disk", "Ctrl-C"])
def test_what_stops_a_move_leaves_one_result(
    stop: str,
    old: Diagnosis | None,
    new: Diagnosis,
    place: Callable[[Files], Path],
    files: Callable[[Diagnosis | None], Files],
) -> None:
    before, after, ends, said = files(old), files(new), list[Files](), list[str]()
    while len(said) == len(ends):
        out = place(before)
        with pytest.MonkeyPatch.context() as patch:
            _raising(patch, len(ends), stop)
            try:
                _save(after, out)
            except (InputError, KeyboardInterrupt) as error:
                said.append(str(error))
        assert not list(out.parent.rglob(".rwn-*"))
        ends.append(_files(out))
    assert len(ends) > 5
    assert ends.pop() == after
    if stop == "full disk":
        assert all(end == before for end in ends)
        assert all("what was there is as it was; expected room" in line for line in said)
    else:
        assert all(end in (before, after) for end in ends)
        assert ends[-1] == after


@pytest.mark.slow
@forks
def test_what_waits_does_not_take_the_place_of_a_later_result(
    place: Callable[[Files], Path], files: Callable[[Diagnosis | None], Files]
) -> None:
    change, waited = 0, 0
    while True:
        out = place(files(with_model))
        if _stopped_before(change, files(without), out):
            break
        change += 1
        if not list(out.glob(".rwn-*/[dw]*")):
            continue
        waited += 1
        for name in _files(out):
            (out / name).unlink()
        for name, content in files(later).items():
            (out / name).write_bytes(content)
        assert Diagnosis.load(out) == later
        check_folder(out)
        assert _files(out) == files(later)
    assert waited > 5


def test_a_reader_is_refused_what_changes_as_it_reads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with_model.save(tmp_path)
    read = Path.read_bytes

    def late(path: Path) -> bytes:
        if path.name == "curves.json":
            without.save(tmp_path, overwrite=True)
        return read(path)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "read_bytes", late)
        with pytest.raises(InputError, match="is being replaced"):
            Diagnosis.load(tmp_path)
    assert Diagnosis.load(tmp_path) == without
    assert Diagnosis.load(tmp_path).corrected is None
