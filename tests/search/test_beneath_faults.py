"""Whether a suspected fault is believed, by what it leaves and what physics leaves: a table of figures.

The rankings are made up: what each leaves above the noise, in units of it, is given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rwn
from made_up_motor import MOTOR
from rwn.faults.delay import SuspectedFault
from rwn.faults.fault import GEAR, SHIFT, Fault
from rwn.fit.budget import meter
from rwn.search import beneath_faults

FAULT = Fault(name=SHIFT, signals=("speed",), meaning="", delay=4, step=1e-3)
BEFORE, AFTER = 8.0, 1.0  # of the refitted model, with the fault and without
MODEL = rwn.Model(kind="dc", parameters=MOTOR)


@dataclass(frozen=True, kw_only=True)
class Left:
    """What is left above the noise: by one effect with the fault in, by two, by more pairs; by one without the fault,
    and by as many effects as it takes."""

    alone: float = 5.0
    pairs: float = 3.0
    more: float = 3.0
    beneath: float = 0.05
    whole: float = 0.05
    moves: int = 0  # times that the delay moves as it is refined


CASES: dict[str, tuple[Left, bool]] = {
    "one effect does as well": (Left(alone=0.05), False),
    "one effect beneath it does all, and no pair does without": (Left(), True),
    "a pair without it does as well": (Left(pairs=0.06), False),
    "a pair without it does all": (Left(pairs=0.05, beneath=0.5), False),
    "one effect beneath it does most, and no pair comes near": (Left(beneath=0.5), True),
    "one effect beneath it does most, and so do other pairs": (Left(beneath=0.5, more=0.4), False),
    "more effects beneath it do all": (Left(beneath=2.0), True),
    "more effects beneath it leave something": (Left(beneath=2.0, whole=1.0), False),
    "it hardly helps": (Left(beneath=4.5), False),
    "it stays as it is once it moved": (Left(moves=1), True),
    "it keeps moving, and does all": (Left(moves=9), True),
    "it keeps moving, and does not": (Left(moves=9, beneath=2.0), False),
}


@pytest.mark.parametrize("case", CASES)
def test_a_fault_is_believed_where_physics_does_less(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    left, believed = CASES[case]
    right = [object()]
    moves = iter(range(1, 1 + left.moves))

    def ranking(of: Sequence[Any], at_once: int = 3, *, names: Any = None, after: Any = None) -> Any:  # noqa: ARG001
        inside = of is right
        kind = {1: "alone", 2: "pairs"}[at_once] if inside else {1: "beneath", 3: "whole"}[at_once]
        again = kind == "pairs" and after is not None and after.left == left.pairs
        found = left.more if again else getattr(left, kind)
        return SimpleNamespace(kind=kind, left=found, problem=SimpleNamespace(work=meter(1.0)))

    def refined(suspect: SuspectedFault, *_: Any) -> tuple[Fault, float]:
        step = next(moves, None)
        return (suspect.fault if step is None else replace(suspect.fault, delay=4 + step)), left.beneath

    monkeypatch.setattr(beneath_faults, "unexplained", lambda _, found: found.left)
    monkeypatch.setattr(beneath_faults, "refined", refined)
    monkeypatch.setattr(beneath_faults, "without", lambda of, _: list(of))
    for name in ("rivals", "first_effects"):
        monkeypatch.setattr(beneath_faults, name, lambda *_: [])
    suspect = SuspectedFault(fault=FAULT, noise={}, before=BEFORE, after=AFTER)
    fault, found, _ = beneath_faults._decided(suspect, right, MODEL, ranking)  # type: ignore[arg-type]
    assert (fault is not None) == believed
    if fault is None:
        assert found is not None
        assert found.kind in ("alone", "pairs"), "the recordings as they are"  # type: ignore[attr-defined]
    else:
        assert fault.delay == 4 + min(left.moves, beneath_faults.MOST_REFINEMENTS)
        assert found is None or found.kind in ("beneath", "whole")  # type: ignore[attr-defined]
        if left.moves >= beneath_faults.MOST_REFINEMENTS:
            assert found is None, "what was found beneath another delay is not kept"


@pytest.mark.parametrize(
    ("off", "needless", "again"), [(1.002, False, False), (1.05, False, True), (1.05, True, False)]
)
def test_what_is_beneath_a_gear_is_found_anew_where_its_ratio_was_off(
    off: float, needless: bool, again: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With every other fault undone, as the ratio was fitted; a gear that is not needed is none."""
    time = 1e-3 * np.arange(200)
    speed = 30.0 * np.sin(40.0 * time)
    run = rwn.Recording(name="run", time=time, signals={"voltage": np.cos(40.0 * time), "speed": speed})
    gear = Fault(name=GEAR, signals=("speed",), meaning="", factor=0.3)
    other = Fault(name="wrong-sign", signals=("voltage",), meaning="", factor=-1.0)
    seen: list[rwn.Recording] = []

    def ratio(known: Fault, of: Sequence[rwn.Recording], *_: Any) -> Fault:
        seen.extend(of)
        return replace(known, factor=off * known.factor)

    def ranking(of: Sequence[rwn.Recording]) -> str:
        seen.extend(of)
        return "anew"

    monkeypatch.setattr(beneath_faults, "gear_ratio", ratio)
    monkeypatch.setattr(beneath_faults, "is_needless", lambda *_: needless)
    faults, found = beneath_faults._geared(gear, [other, gear], [run], MODEL, "first", ranking)  # type: ignore[arg-type]
    assert found == ("anew" if again or needless else "first")
    kept = [] if needless else [replace(gear, factor=off * 0.3) if again else gear]
    assert faults == [other, *kept]
    np.testing.assert_allclose(seen[0].signals["voltage"], -run.signals["voltage"])
    np.testing.assert_allclose(seen[0].signals["speed"], speed)
    np.testing.assert_allclose(seen[1].signals["speed"], speed)  # what explains it without the gear
    if again:
        np.testing.assert_allclose(seen[2].signals["speed"], speed / (off * 0.3))
        np.testing.assert_allclose(seen[2].signals["voltage"], -run.signals["voltage"])
