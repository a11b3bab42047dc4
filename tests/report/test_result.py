"""A diagnosis in the hands of its user: shown, compared, tabulated, drawn, saved and read back."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import made_up
import rwn
from rwn.errors import InputError
from rwn.report.diagnosis import Diagnosis

ROOT = Path(__file__).resolve().parents[2]
DEMO = Path(rwn.__file__).parent / "demo"
STATES = pytest.mark.parametrize("made", made_up.ALL.values(), ids=list(made_up.ALL))


@STATES
def test_it_is_short_to_look_at(made: Callable[[], Diagnosis]) -> None:
    found = made()
    assert repr(found).startswith(f"<Diagnosis {found.verdict}")
    assert len(repr(found)) < 200
    assert str(found).endswith(".")
    assert found._repr_html_().count("<p>") == 1


def test_its_curves_are_short_to_look_at() -> None:
    curves = made_up.found().curves
    shown = [repr(plot) for plot in curves]
    assert all(words.startswith(f"<Plot {plot.slot} '") for words, plot in zip(shown, curves, strict=True))
    assert len(set(shown)) == len(shown)
    for trace in (trace for plot in curves for trace in plot.traces):
        assert f"'{trace.name}' ({trace.role}): {trace.x.size} points" in repr(trace)
        shown.append(repr(trace))
    assert max(map(len, shown)) < 150


def test_its_html_is_escaped() -> None:
    effect = replace(made_up.found().effects[0], name="<script>")
    assert "<script>" not in replace(made_up.found(), effects=(effect,))._repr_html_()


def test_equal_means_the_same_curves_too() -> None:
    found, again = made_up.found(), made_up.found()
    assert found == again
    assert found == replace(again, elapsed=1.0, command="another")
    plot = again.curves[0]
    other = replace(plot.traces[0], y=plot.traces[0].y + 1.0)
    assert found != replace(again, curves=(replace(plot, traces=(other, *plot.traces[1:])), *again.curves[1:]))


def test_it_is_equal_to_nothing_else() -> None:
    assert made_up.found() != "missing-physics"
    assert made_up.found() != made_up.found().to_json()


def test_it_can_be_pickled_with_its_corrected_model() -> None:
    found = replace(made_up.found(), corrected=rwn.read_model(DEMO / "model.toml"))
    assert pickle.loads(pickle.dumps(found)) == found
    assert copy.deepcopy(found) == found


@pytest.mark.usefixtures("without_pandas")
def test_the_table_is_plain_rows_without_pandas() -> None:
    (row,) = made_up.found().table()
    assert (row["effect"], row["value"], row["low"], row["unit"]) == ("coulomb-friction", 0.0208, 0.0203, "N m")


def test_the_table_is_a_data_frame_with_pandas() -> None:
    pandas = pytest.importorskip("pandas")
    table = made_up.ambiguous().table()
    assert isinstance(table, pandas.DataFrame)
    assert list(table["parameter"]) == ["gap", "load_inertia"]
    assert list(made_up.adequate().table().columns) == list(table.columns)


def test_it_draws_the_figures_of_the_report() -> None:
    pytest.importorskip("plotly")
    found = made_up.found()
    assert found.plots == ("heldout_1.csv", "Unknown torque over speed", "Torque against speed")
    drawn = found.plot()
    measured = found.curves[0].traces[0]
    assert [line.name for line in drawn.data][:4] == ["measured", "nominal as given", "nominal refitted", "corrected"]
    np.testing.assert_allclose(drawn.data[0].y, measured.y, rtol=1e-6)
    assert drawn.layout.yaxis.title.text == "Speed [rad/s]"
    with pytest.raises(InputError, match=r"did you mean 'heldout_1\.csv'"):
        found.plot("heldout_1")
    with pytest.raises(InputError, match="no curves"):
        replace(found, curves=()).plot()


def test_what_is_saved_is_read_back(tmp_path: Path) -> None:
    found = replace(made_up.found(), corrected=rwn.read_model(DEMO / "model.toml"))
    found.save(tmp_path / "a")
    again = Diagnosis.load(tmp_path / "a")
    assert again == found
    assert again != made_up.found()  # which holds no corrected model
    again.save(tmp_path / "b")
    for name in ("diagnosis.json", "curves.json", "corrected.toml"):
        assert (tmp_path / "b" / name).read_bytes() == (tmp_path / "a" / name).read_bytes()
    with pytest.raises(InputError, match="overwrite"):
        found.save(tmp_path / "a")


def test_without_its_curves_it_is_read_all_the_same(tmp_path: Path) -> None:
    made_up.found().save(tmp_path / "a")
    (tmp_path / "a" / "curves.json").unlink()
    assert Diagnosis.load(tmp_path / "a") == replace(made_up.found(), curves=())


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("diagnosis.json", None, "there is no diagnosis.json in this folder"),
        ("diagnosis.json", "{", "no diagnosis of this version"),
        ("diagnosis.json", "[]", "no diagnosis of this version"),
        ("diagnosis.json", '{"verdict": "perhaps"}', "no diagnosis of this version"),
        ("diagnosis.json", '{"format": 99, "verdict": "adequate"}', "format 99"),
        ("curves.json", "{}", "no 'curves' in curves.json"),
        ("curves.json", "[1]", "no diagnosis of this version"),
        ("curves.json", "\x00", "no diagnosis of this version"),
        ("curves.json", "[" * 100_000, "no diagnosis of this version"),
    ],
)
def test_what_is_no_diagnosis_is_refused_in_one_line(tmp_path: Path, name: str, text: str | None, said: str) -> None:
    made_up.found().save(tmp_path / "a")
    (tmp_path / "a" / name).unlink()
    if text is not None:
        (tmp_path / "a" / name).write_text(text)
    with pytest.raises(InputError, match=said) as refusal:
        Diagnosis.load(tmp_path / "a")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("key", ["x", "y", "at"])
def test_curves_whose_arrays_do_not_belong_together_are_refused(tmp_path: Path, key: str) -> None:
    made_up.found().save(tmp_path / "a")
    curves = json.loads((tmp_path / "a" / "curves.json").read_text())
    next(t for plot in curves["curves"] for t in plot["traces"] if t.get("at"))[key].pop()
    (tmp_path / "a" / "curves.json").write_text(json.dumps(curves))
    with pytest.raises(InputError, match=r"no diagnosis of this version .*has \d+ values, x has \d+"):
        Diagnosis.load(tmp_path / "a")


@STATES
def test_it_keeps_to_its_schema(made: Callable[[], Diagnosis]) -> None:
    jsonschema.validate(json.loads(made().to_json()), Diagnosis.schema())


def test_the_schema_is_no_empty_promise() -> None:
    plain = json.loads(made_up.found().to_json())
    for broken in ({**plain, "verdict": "perhaps"}, {**plain, "effects": [{"name": 1}]}, {"verdict": "adequate"}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(broken, Diagnosis.schema())


def test_the_published_schema_is_that_of_this_version() -> None:
    published = json.loads((ROOT / "docs/diagnosis.schema.json").read_text())
    assert published == json.loads(json.dumps(Diagnosis.schema()))


def test_the_file_of_a_diagnosis_is_small() -> None:
    assert len(made_up.found().to_json()) < 20_000
