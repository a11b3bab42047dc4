"""`rwn evidence` from a machine to its files and its section of the page, with a machine that is made up."""

from __future__ import annotations

from pathlib import Path

import pytest

import made_up
from rwn.studies.machines.hand_fit import HANDS
from rwn.studies.machines.machine import Error, Machine, Outcome
from rwn.studies.machines.registry import MACHINES
from rwn.studies.machines.runner import run_machines

ERROR = Error(measure="speed [rad/s]", nominal=3.0, refitted=2.0, corrected=1.0)
OUTCOME = Outcome(machine="Bench motor", begins_with="linear", found=made_up.found(), errors=(ERROR,))


@pytest.fixture(autouse=True)
def bench(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine of the registry that needs no recordings."""
    run = Machine(name="bench", folder="bench", source="nobody", run=lambda *_: (OUTCOME,))
    monkeypatch.setitem(MACHINES, "bench", run)
    monkeypatch.setitem(HANDS, "bench", lambda _: {("Bench motor", "speed [rad/s]"): 1.5})


def test_a_machine_leaves_its_table_its_diagnosis_and_its_report(tmp_path: Path) -> None:
    text = run_machines(["bench"], tmp_path, tmp_path)
    assert "| speed [rad/s] | 3 | 2 | 1 |  |" in text
    assert (tmp_path / "table.md").read_text() == text
    assert (tmp_path / "bench-motor.json").read_bytes() == made_up.found().to_json()
    assert "Coulomb friction" in (tmp_path / "bench-motor.html").read_text()


def test_fits_by_hand_stand_beside_and_the_section_of_the_page_says_who_made_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "page.md"
    page.write_text("above\n<!-- rwn evidence bench -->\nold\n<!-- end -->\nbelow\n")
    text = run_machines(["bench"], tmp_path, tmp_path, by_hand=True, page=page)
    assert "| speed [rad/s] | 3 | 2 | 1 | 1.5 |" in text
    assert "bench: fitted by hand" in capsys.readouterr().err
    written = page.read_text()
    assert text in written
    assert "diagnosed in 7 s." in written
    assert "old" not in written
    assert written.startswith("above\n")
    assert written.endswith("<!-- end -->\nbelow\n")
