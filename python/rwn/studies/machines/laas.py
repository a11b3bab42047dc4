"""LAAS: a brushless motor of a legged robot under field-oriented control, swung to and fro by its voltage."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rwn.recording.recording import Recording, read_recording
from rwn.report.diagnosis import Diagnosis
from rwn.studies.machines.machine import Machine, Outcome, Say, cut, data_file, error_of, judged, nominal_model

FITTED, JUDGED = (0, 10000), (15000, 25000)  # rows of 1 ms; nothing of one is in the other


def run(folder: Path, say: Say) -> tuple[Outcome, ...]:
    """Ten seconds of `acc_current` are fitted, ten later ones judge."""
    train, test = parts(folder)
    outcome = judged("LAAS", "linear motor", nominal_model("laas"), [train], [test], say)
    errors = [
        error_of(outcome.found, test.name, signal, f"{signal}, later rows [{unit}]")
        for signal, unit in (("speed", "rad/s"), ("current", "A"))
    ]
    return (replace(outcome, errors=tuple(errors), notes=_dry_friction(outcome.found)),)


def parts(folder: Path) -> tuple[Recording, Recording]:
    """What is fitted, and what judges."""
    whole = read_recording(data_file(folder, "acc_current.txt"), layout=nominal_model("laas").recording)
    first, second = (replace(cut(whole, *rows), name=f"rows {rows[0]} to {rows[1]}") for rows in (FITTED, JUDGED))
    return first, second


def _dry_friction(found: Diagnosis) -> tuple[str, ...]:
    """Its level; 2.3 mN m is what the motor's users state."""
    levels = [
        f"{e.name} {1e3 * e.parameters['coulomb_torque'].value:.2f} mN m (its users: 2.3)"
        for e in found.effects
        if "coulomb_torque" in e.parameters
    ]
    return tuple(levels)


MACHINE = Machine(name="laas", folder="laas_bldc", source="heitor-andrade/laas_anti_cogging", run=run)
