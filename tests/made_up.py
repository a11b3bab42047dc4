"""Made-up diagnoses, one for each state that a report can be in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from made_up_curves import law, over_speed, over_time, spectrum
from rwn.decide.account import ActingEffect, Remainder
from rwn.decide.evidence import Evidence
from rwn.fit.intervals import Estimate
from rwn.mismatch_map.regions import Region
from rwn.name.found_effect import FoundEffect
from rwn.prove.heldout import HeldoutRow
from rwn.recording.inspection import Finding
from rwn.report.diagnosis import Diagnosis
from rwn.report.diagnosis_data import Alternative, Beneath, Location, Source
from rwn.report.fitted_filter import FittedFilter
from rwn.report.nominal_fit import FittedParameter, NominalFit

REGIONS = (
    Region(
        coordinate="speed",
        low=-12.0,
        high=12.0,
        unit="rad/s",
        share=0.71,
        samples_share=0.09,
        name="reversals",
    ),
    Region(coordinate="speed", low=12.0, high=180.0, unit="rad/s", share=0.16, samples_share=0.45, name="forward"),
    Region(
        coordinate="speed",
        low=-180.0,
        high=-12.0,
        unit="rad/s",
        share=0.13,
        samples_share=0.46,
        name="backward",
    ),
)
SPIKES = Finding(
    kind="spikes",
    recording="train_1.csv",
    signals=("speed",),
    count=3,
    words="3 single samples of the speed are far off those beside them",
    done="left out",
)
SOURCES = (
    Source(path="model.toml", use="model", sha256="8f14e45fceea167a5a36dedd4bea2543"),
    Source(
        path="train_1.csv",
        use="fit",
        samples=5138,
        duration=5.137,
        sha256="c9f0f895fb98ab9159f51fd0297e236d",
    ),
    Source(path="heldout_1.csv", use="heldout", samples=3227, duration=3.226),
)


def _row(recording: str, region: str, errors: tuple[float, float, float | None], gain: float | None) -> HeldoutRow:
    return HeldoutRow(
        recording=recording,
        region=region,
        signal="speed",
        unit="rad/s",
        samples=5138,
        nominal=errors[0],
        refitted=errors[1],
        corrected=errors[2],
        noise_floor=0.79,
        gain=gain,
        gain_interval=None if gain is None else (gain - 0.04, gain + 0.03),
    )


def _fit() -> NominalFit:
    def parameter(nominal: float, unit: str, doubt: float, refitted: float, corrected: float) -> FittedParameter:
        def near(value: float) -> Estimate:
            return Estimate(value=value, unit=unit, interval=(0.98 * value, 1.02 * value))

        return FittedParameter(nominal=nominal, uncertainty=doubt, refitted=near(refitted), corrected=near(corrected))

    return NominalFit(
        parameters={
            "resistance": parameter(0.8102, "ohm", 0.044, 0.82, 0.815),
            "inductance": parameter(1.5e-3, "H", 0.11, 1.4e-3, 1.48e-3),
            "torque_constant": parameter(0.105, "N m/A", 0.11, 0.099, 0.104),
            "inertia": parameter(3.24e-4, "kg m^2", 0.12, 3.5e-4, 3.25e-4),
            "viscous_friction": parameter(7e-5, "N m s/rad", 0.34, 2.4e-4, 7.1e-5),
        },
        advice="Viscous friction tripled when refitted alone: it stood in for the dry friction.",
    )


def acting(name: str, probability: float, share: float) -> ActingEffect:
    """An effect of the account."""
    evidence = Evidence(share=share, unseen=share, part=share, odds=9.0, curve=1.0)
    return ActingEffect(name=name, probability=probability, together=probability, share=share, evidence=evidence)


def found() -> Diagnosis:
    """One effect, named with confidence."""
    rng = np.random.default_rng(1)
    effect = FoundEffect(
        name="coulomb-friction",
        equation="mechanical",
        probability=0.97,
        parameters={"coulomb_torque": Estimate(value=0.0208, unit="N m", interval=(0.0203, 0.0213))},
        formula="T = -T_c sign(w), holds up to T_c at standstill",
        meaning="dry friction of constant level",
    )
    return Diagnosis(
        verdict="missing-physics",
        equation="mechanical",
        effects=(effect,),
        set=("coulomb-friction",),
        explanation=Alternative(effects=("coulomb-friction",), probability=0.94),
        alternatives=(
            Alternative(
                effects=("stribeck-friction",),
                probability=0.02,
                separated_by="a slow ramp through zero speed",
            ),
            Alternative(effects=("brush-voltage-drop",), probability=0.01, separated_by="braking from speed"),
        ),
        location=Location(
            equation="mechanical",
            regions=REGIONS,
            description="a torque that depends on the direction of motion, 21 mN m, and hardly on speed",
        ),
        nominal_fit=_fit(),
        heldout=(
            _row("heldout_1.csv", "all", (14.2, 6.31, 0.83), 0.868),
            _row("heldout_1.csv", "reversals", (31.0, 14.9, 0.91), 0.939),
            _row("heldout_2.csv", "all", (9.8, 4.42, 0.81), 0.817),
        ),
        curves=(*over_time(rng), over_speed(rng), law()),
        account=(acting("coulomb-friction", 0.97, 0.985),),
        remainder=Remainder(share=0.015, error=1.02),
        findings=(SPIKES,),
        sensor_filters=(
            FittedFilter(signal="speed", time_constant=Estimate(value=2.7e-3, unit="s", interval=(2.6e-3, 2.8e-3))),
        ),
        next_experiment="None needed for this name. A slow ramp through zero would bound any Stribeck part.",
        sources=SOURCES,
        command="rwn diagnose train_1.csv --model model.toml --heldout heldout_1.csv --out out",
        version="0.1.0",
        elapsed=7.42,
    )


def adequate() -> Diagnosis:
    """Nothing is missing."""
    one = found()
    heldout = (_row("heldout_1.csv", "all", (3.1, 0.81, None), None),)
    return replace(
        one,
        verdict="adequate",
        equation="",
        effects=(),
        set=(),
        explanation=Alternative(effects=(), probability=0.96),
        alternatives=(),
        location=Location(),
        heldout=heldout,
        curves=one.curves[:3],
        account=(),
        next_experiment="",
        adequate_probability=0.96,
    )


def unexplained() -> Diagnosis:
    """Something without a name; the learned law is the correction."""
    one = found()
    location = replace(one.location, description="a torque that depends on angle, 14 periods per revolution, 3 mN m")
    return replace(
        one,
        verdict="unexplained",
        effects=(),
        set=(),
        explanation=None,
        alternatives=(),
        location=location,
        curves=(*one.curves[:4], spectrum(np.random.default_rng(2))),
        account=(acting("unbalance", 0.31, 0.22), acting("coulomb-friction", 0.02, 0.04)),
        remainder=Remainder(share=1.0, error=8.0, signals=("speed",)),
        warnings=("train_1.csv, line 812: 2 gap(s) of up to 4.0 sample times, where rows are missing",),
        next_experiment="Turn the shaft slowly by hand over two revolutions, drive switched off.",
    )


def ambiguous() -> Diagnosis:
    """A set of effects that the recordings cannot tell apart, two of them with several parameters."""
    one = found()
    backlash = FoundEffect(
        name="backlash",
        equation="mechanical",
        probability=0.46,
        meaning="play between motor and load",
        parameters={
            "gap": Estimate(value=0.0121, unit="rad", interval=(0.009, 0.019)),
            "load_inertia": Estimate(value=0.43, unit="1", interval=(0.38, 0.48)),
        },
        formula="shaft torque is zero inside the gap",
    )
    return replace(
        one,
        effects=(backlash,),
        set=("backlash", "shaft-compliance", "presliding-hysteresis"),
        explanation=Alternative(effects=("backlash",), probability=0.46),
        alternatives=(
            Alternative(effects=("shaft-compliance",), probability=0.34, separated_by="two reversal amplitudes"),
        ),
        next_experiment="Reverse with two amplitudes, 5 % and 50 % of the rated voltage, at 1 Hz.",
    )


def mistake() -> Diagnosis:
    """A recording mistake."""
    effect = FoundEffect(
        name="wrong-unit",
        equation="recording",
        probability=0.99,
        meaning="speed in rpm taken for rad/s",
    )
    return replace(
        adequate(), verdict="recording-mistake", equation="recording", effects=(effect,), set=("wrong-unit",),
        beneath=Beneath(verdict="adequate"), heldout=(),
    )  # fmt: skip


ALL = {state.__name__: state for state in (found, adequate, unexplained, ambiguous, mistake)}
