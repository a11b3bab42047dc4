"""What must not happen again: a hostile input ends in one line and an exit code, and what was there is as it was."""

from __future__ import annotations

import os
import resource
import stat
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from command_line import MODEL
from rwn import cli
from rwn.errors import InputError, plain
from rwn.model.files import read_model
from rwn.model.vocabulary import table
from rwn.report.output_files import check_file, check_folder, output_file, output_folder

HEADER = "time [s],voltage [V],speed [rad/s]\n"
Refused = Callable[..., str]


def _rows(shift: float = 0.0) -> str:
    t = np.arange(200) * 1e-3
    columns = (t, 5.0 * np.sin(60.0 * t + shift), 40.0 * np.sin(60.0 * t - 0.7 + shift))
    return "".join(f"{a:.6g},{b:.6g},{c:.6g}\n" for a, b, c in zip(*columns, strict=True))


def _run(arguments: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    monkeypatch.setattr(sys, "argv", ["rwn", *arguments])
    with pytest.raises(SystemExit) as end:
        cli.main()
    return int(end.value.code or 0), capsys.readouterr().err


def _seen(folder: Path) -> dict[Path, tuple[int, ...]]:
    """What is in a folder, and whether it was touched; a folder's own time changes with what is written aside."""
    seen = {}
    for path in folder.rglob("*"):
        at = path.lstat()
        seen[path] = (at.st_mode, at.st_ino) if path.is_dir() else (at.st_mode, at.st_ino, at.st_size, at.st_mtime_ns)
    return seen


@pytest.fixture
def refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Refused:
    """Runs a command in a folder with a.csv, b.csv, motor.toml: its one line; nothing may be searched or changed."""

    def search(*_: object, **__: object) -> None:
        raise AssertionError("it searched")

    monkeypatch.setattr("rwn.diagnose", search)
    (tmp_path / "a.csv").write_text(HEADER + _rows())
    (tmp_path / "b.csv").write_text(HEADER + _rows(0.1))
    (tmp_path / "motor.toml").write_text(MODEL)
    monkeypatch.chdir(tmp_path)

    def run(*arguments: str, code: int = 2) -> str:
        before = _seen(tmp_path)
        ended, said = _run(list(arguments), monkeypatch, capsys)
        assert ended == code
        (line,) = said.splitlines()
        assert line.startswith("rwn: ")
        assert line.isprintable()
        assert len(line) < 4100
        assert _seen(tmp_path) == before
        return line

    return run


DIAGNOSE = ("diagnose", "a.csv", "--model", "motor.toml", "--out", "out")
SIMULATE = ("simulate", "motor.toml", "--input", "a.csv", "--out", "sim.csv")


@pytest.mark.parametrize("copied", ["copy", "hard link", "other columns' order", "cut", "from another instant on"])
def test_a_copy_of_a_fitted_recording_proves_nothing(copied: str, refused: Refused) -> None:
    if copied == "hard link":
        os.link("a.csv", "copy.csv")
    else:
        cells = [line.split(",") for line in Path("a.csv").read_text().splitlines()]
        order = (2, 0, 1) if copied == "other columns' order" else (0, 1, 2)
        if copied == "cut":
            del cells[120:]
        elif copied == "from another instant on":
            del cells[1:60]
            cells = [cells[0], *([f"{float(row[0]) + 7.0:.6g}", *row[1:]] for row in cells[1:])]
        Path("copy.csv").write_text("".join(",".join(row[j] for j in order) + "\n" for row in cells))
    assert "given twice, as a.csv too" in refused(*DIAGNOSE, "--heldout", "copy.csv")


@pytest.mark.parametrize("heldout", ["--heldout=b.csv", "--heldout b.csv"])
@pytest.mark.parametrize("between", ["", "--overwrite", "--seed 1", "--effort=0.1"])
def test_a_stray_file_after_heldout_is_not_fitted(heldout: str, between: str, refused: Refused) -> None:
    assert "'c.csv' follows --heldout b.csv" in refused(*DIAGNOSE, *heldout.split(), *between.split(), "c.csv")


def test_a_full_disk_leaves_the_old_result_and_names_the_place(tmp_path: Path) -> None:
    (tmp_path / "diagnosis.json").write_text("old")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)

    def write() -> None:
        with output_folder(tmp_path, overwrite=True) as aside:
            (aside / "diagnosis.json").write_text("x" * 2**20)

    resource.setrlimit(resource.RLIMIT_FSIZE, (2**16, limits[1]))
    try:
        with pytest.raises(InputError, match=f"{tmp_path}: .*; expected room"):
            write()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert [p.name for p in tmp_path.iterdir()] == ["diagnosis.json"]
    assert (tmp_path / "diagnosis.json").read_text() == "old"


def test_results_are_written_on_the_disk_where_they_belong(tmp_path: Path) -> None:
    with output_folder(tmp_path / "deep" / "out") as aside:
        assert aside.stat().st_dev == tmp_path.stat().st_dev
        assert aside.is_relative_to(tmp_path)
        (aside / "report.html").write_text("new")
    assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == ["report.html"]


BOUNDED = [(e.name, p.name) for e in table().values() for p in e.parameters if p.lower >= 0.0 and not p.cyclic]


@pytest.mark.parametrize("value", ["-1", "1e30", "nan"])
@pytest.mark.parametrize(("effect", "parameter"), BOUNDED)
def test_effects_out_of_their_bounds_are_refused(effect: str, parameter: str, value: str, tmp_path: Path) -> None:
    values = {p.name: p.start if p.start else 0.1 for p in table()[effect].parameters}
    lines = [f"{name} = {value if name == parameter else number!r}" for name, number in values.items()]
    (tmp_path / "motor.toml").write_text(MODEL + f"[effects.{effect}]\n" + "\n".join(lines) + "\n")
    with pytest.raises(InputError, match=parameter):
        read_model(tmp_path / "motor.toml")


def test_a_unit_that_contradicts_the_header_is_refused(refused: Refused) -> None:
    Path("motor.toml").write_text(MODEL + '[recording]\ncolumns.speed = { source = "speed", unit = "rpm" }\n')
    assert "is in [rad/s], the map says 'rpm'" in refused(*SIMULATE)


def test_a_device_is_not_replaced() -> None:
    before = stat.S_IMODE(Path("/dev/null").stat().st_mode)
    with (
        pytest.raises(InputError, match="not a regular file"),
        output_file(Path("/dev/null"), overwrite=True) as aside,
    ):
        aside.write_text("x")
    assert stat.S_IMODE(Path("/dev/null").stat().st_mode) == before


@pytest.mark.parametrize(
    "arguments",
    [
        ("identify", "a.csv", "--model", "motor.toml", "--out", "a.csv", "--overwrite"),
        ("identify", "a.csv", "--model", "motor.toml", "--out", "motor.toml", "--overwrite"),
        ("simulate", "motor.toml", "--input", "a.csv", "--out", "a.csv", "--overwrite"),
        ("diagnose", "a.csv", "--model", "old/corrected.toml", "--out", "old", "--overwrite"),
        ("simulate", "motor.toml", "--input", "a.csv", "--out", "new/../a.csv", "--overwrite"),
        ("report", "old", "--out", "old/corrected.toml", "--overwrite"),
    ],
)
def test_an_input_is_never_an_output(arguments: tuple[str, ...], refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "corrected.toml").write_text(MODEL)
    assert "would replace an input" in refused(*arguments)


@pytest.mark.parametrize("kind", ["pipe", "/dev/zero", "loop", "folder"])
@pytest.mark.parametrize("given", ["motor.toml", "a.csv"])
def test_what_is_no_file_is_not_read(given: str, kind: str, refused: Refused) -> None:
    Path(given).unlink()
    if kind == "pipe":
        os.mkfifo(given)
    elif kind == "folder":
        Path(given).mkdir()
    else:
        Path(given).symlink_to(given if kind == "loop" else kind)
    line = refused(*SIMULATE)
    assert given in line
    assert "; fix: " in line


@pytest.mark.parametrize("kind", ["pipe", "/dev/zero", "loop", "folder"])
@pytest.mark.parametrize("given", ["diagnosis.json", "curves.json"])
def test_what_is_no_file_is_not_read_as_a_result(given: str, kind: str, refused: Refused) -> None:
    Path("old").mkdir()
    Path("old/diagnosis.json").write_text("{}")
    path = Path("old") / given
    path.unlink(missing_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    else:
        path.symlink_to(path.name if kind == "loop" else kind)
    assert "; fix: " in refused("report", "old", "--out", "report.html")


@pytest.mark.parametrize("out", ["/dev/null", "motor.toml", "dangling", "motor.toml/deep"])
@pytest.mark.parametrize(
    "command",
    [("trials", "make", "--seed", "7", "--count", "1"), ("trials", "spoil", "set"), ("thesis", "run", "--table", "5")],
)
def test_a_study_does_not_start_where_it_cannot_write(command: tuple[str, ...], out: str, refused: Refused) -> None:
    Path("set").mkdir()
    Path("dangling").symlink_to("nowhere")
    assert "choose another" in refused(*command, "--out", out)


HOSTILE_MODELS = {
    "401 digits": MODEL.replace("0.8", "8" * 401),
    "10 000 digits": MODEL.replace("0.8", "8" * 10_000),
    "401 digits as an uncertainty": MODEL + "[uncertainty]\ninertia = " + "8" * 401 + "\n",
    "401 digits as an order": '[motor]\nkind = "lti"\norder = ' + "8" * 401 + "\n",
    "401 digits as a sample time": MODEL + "[recording]\nsample_time = " + "8" * 401 + "\n",
    "lists 900 deep": MODEL + "x = " + "[" * 900 + "]" * 900 + "\n",
    "lists 100 000 deep": "x = " + "[" * 100_000,
    "tables 3000 deep": "x = " + "{a = " * 3000 + "1" + "}" * 3000,
    "a scale of 1e300": MODEL + '[recording]\ncolumns.speed = { source = "speed", scale = 1e300 }\n',
    "a scale of 401 digits": MODEL + '[recording]\ncolumns.speed = { source = "speed", scale = ' + "8" * 401 + " }\n",
    "a signal scaled to nothing": MODEL + '[recording]\ncolumns.voltage = { source = "voltage", scale = 1e-14 }\n',
    "an uncertainty of 1e300": MODEL + "[uncertainty]\ninertia = 1e300\n",
    "control characters in a key": MODEL + '"\\u001b[2J" = 1.0\n',
    "from after to": MODEL + "[recording]\nfrom = 2.0\nto = 1.0\n",
    "nothing between from and to": MODEL + "[recording]\nfrom = 20.0\n",
    "every 0th row": MODEL + "[recording]\ndecimate = 0\n",
    "every 100th row of 200": MODEL + "[recording]\ndecimate = 100\n",
}  # fmt: skip


@pytest.mark.parametrize("case", HOSTILE_MODELS)
def test_a_hostile_model_is_refused_in_one_line(case: str, refused: Refused) -> None:
    Path("motor.toml").write_text(HOSTILE_MODELS[case])
    assert "; fix: " in refused(*SIMULATE)


HOSTILE_RECORDINGS = {
    "a name of a million letters": "x" * 10**6 + "," + HEADER + "".join(f"1,{row}\n" for row in _rows().splitlines()),
    "a cell that clears the screen": HEADER + _rows().replace("0.05,", "\x1b[2J\x07,"),
    "a header that clears the screen": HEADER.replace("speed", "sped\x1b[2J") + _rows(),
    "a cell of a million digits": HEADER + _rows().replace("0.05,", "9" * 10**6 + ","),
    "1e30 V": HEADER + _rows().replace(",5", ",1e30"),
}


@pytest.mark.parametrize("case", HOSTILE_RECORDINGS)
def test_a_hostile_recording_is_refused_in_one_line(case: str, refused: Refused) -> None:
    Path("a.csv").write_text(HOSTILE_RECORDINGS[case])
    assert "a.csv" in refused(*SIMULATE)


def test_a_run_that_does_not_reach_its_end_is_no_result(
    refused: Refused, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    k = '{ unit = "N m s/rad", lower = 0, upper = 10, start = 1, strength = true, meaning = "slope" }'
    driven = f'[own_effects.drive]\nterm = "torque"\nequation = "k * speed"\nparameters.k = {k}\n'
    Path("motor.toml").write_text(MODEL + driven + "[effects.drive]\nk = 0.3\n")
    assert "diverged" in refused(*SIMULATE, code=3)
    code, said = _run([*SIMULATE, "--partial"], monkeypatch, capsys)
    assert code == 3
    assert "held from there on" in said
    assert Path("sim.csv").exists()


def test_options_are_refused_before_the_search(refused: Refused) -> None:
    assert "--seed" in refused(*DIAGNOSE, "--seed", "-1")
    Path("dangling").symlink_to("nowhere")
    assert "leads nowhere" in refused(*DIAGNOSE[:-1], "dangling")
    assert "leads nowhere" in refused(*SIMULATE[:-1], "dangling")
    Path("out2/report.html").mkdir(parents=True)
    assert "this is a folder" in refused(*DIAGNOSE[:-1], "out2", "--overwrite")


def test_what_a_killed_process_left_is_swept_and_what_a_living_one_writes_is_not(tmp_path: Path) -> None:
    dead, alive = tmp_path / ".rwn-99999999-x", tmp_path / f".rwn-{os.getppid()}-x"
    dead.mkdir()
    (dead / "half.json").write_text("{")
    alive.mkdir()
    with output_file(tmp_path / "a.toml") as aside:
        aside.write_text("x")
    assert sorted(p.name for p in tmp_path.iterdir()) == [alive.name, "a.toml"]


@pytest.mark.parametrize("check", [check_folder, check_file])
def test_what_a_process_left_that_was_killed_while_it_looked_is_swept_by_the_next_look(
    check: Callable[[Path], None], tmp_path: Path
) -> None:
    """`rwn thesis` and `rwn trials` look where they may write, and write by other means: nothing else would sweep."""
    (tmp_path / ".rwn-99999999-x").mkdir()
    check(tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_messages_hold_no_control_characters() -> None:
    assert plain("\x1b[2J \x07 \u202e µ°Ω") == "\\x1b[2J \\x07 \\u202e µ°Ω"
    assert len(plain("x" * 10**7)) < 600
