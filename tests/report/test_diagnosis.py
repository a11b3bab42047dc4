from __future__ import annotations

import json

import numpy as np
import pytest

from rwn.fit.intervals import Estimate
from rwn.mismatch_map.regions import Region
from rwn.name.found_effect import FoundEffect
from rwn.prove.heldout import HeldoutRow
from rwn.report.diagnosis import Diagnosis
from rwn.report.diagnosis_data import Alternative, Location
from rwn.report.plot import Plot, Trace


@pytest.fixture
def found() -> Diagnosis:
    effect = FoundEffect(
        name="coulomb-friction",
        equation="mechanical",
        probability=0.97,
        parameters={"coulomb_torque": Estimate(value=20.4, unit="N", interval=(20.1, 20.7))},
    )
    trace = Trace(name="before", role="before", x=np.arange(3.0), y=np.array([1.0, np.nan, 2.0]))
    return Diagnosis(
        verdict="missing-physics",
        equation="mechanical",
        effects=(effect,),
        set=("coulomb-friction", "stribeck-friction"),
        alternatives=(Alternative(effects=("stribeck-friction",), probability=0.03),),
        location=Location(
            equation="mechanical",
            regions=(Region(coordinate="speed", low=-1.0, high=1.0, unit="rad/s", share=0.8, samples_share=0.1),),
        ),
        heldout=(
            HeldoutRow(
                recording="b.csv",
                region="all",
                signal="speed",
                unit="rad/s",
                samples=np.int64(100),  # type: ignore[arg-type]  # NumPy scalars must not break the JSON
                nominal=3.0,
                refitted=2.0,
                corrected=1.0,
                noise_floor=None,
            ),
        ),
        curves=(
            Plot(
                slot="response",
                title="Speed",
                x_label="Time",
                x_unit="s",
                y_label="Speed",
                y_unit="rad/s",
                traces=(trace,),
            ),
        ),
        seed=3,
        version="0.1.0",
        elapsed=1.5,
    )


def test_json_follows_the_contract(found: Diagnosis) -> None:
    plain = json.loads(found.to_json())
    assert plain["verdict"] == "missing-physics"
    assert plain["effects"][0]["parameters"]["coulomb_torque"] == {
        "value": 20.4,
        "unit": "N",
        "interval": [20.1, 20.7],
    }
    assert plain["set"][0] == plain["effects"][0]["name"]
    assert plain["location"]["regions"][0]["share"] == 0.8
    assert "curves" not in plain
    curves = json.loads(found.curves_json())["curves"]
    assert curves[0]["traces"][0]["y"] == [1.0, None, 2.0]
    assert "elapsed" not in plain
    assert "corrected" not in plain


def test_json_round_trip(found: Diagnosis) -> None:
    again = Diagnosis.from_json(found.to_json(), found.curves_json())
    assert again.to_json() == found.to_json()
    assert again == found
    np.testing.assert_array_equal(again.curves[0].traces[0].y, found.curves[0].traces[0].y)


def test_json_is_strict_about_the_verdict(found: Diagnosis) -> None:
    with pytest.raises(ValueError, match="verdict"):
        Diagnosis.from_json(found.to_json().replace(b"missing-physics", b"perhaps"))
