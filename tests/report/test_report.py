from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import made_up
from rwn.report import write_report
from rwn.report.diagnosis import Diagnosis, Plot, Trace
from rwn.report.plots import figure
from rwn.report.tables import heldout_table


def _text(found: Diagnosis, folder: Path) -> str:
    write_report(found, folder / "report.html")
    return (folder / "report.html").read_text(encoding="utf-8")


def _body(text: str) -> str:
    return text.split("</main>")[0]


@pytest.mark.parametrize("state", made_up.ALL)
def test_every_state_opens_offline(state: str, tmp_path: Path) -> None:
    text = _text(made_up.ALL[state](), tmp_path)
    assert not re.search(r'(src|href)="', text.split("</main>")[0])
    assert not re.search(r"<link|@import", _body(text))
    assert text.count("<h1>") == 1
    assert text.rstrip().endswith("</html>")


def test_the_report_shows_what_was_found(tmp_path: Path) -> None:
    body = _body(_text(made_up.found(), tmp_path))
    for shown in (
        "Coulomb friction",
        "20.8 ± 0.5 mN m",
        "97 %",
        "reversals",
        "heldout_2.csv",
        "0.830",
        "[83, 90]",
    ):
        assert shown in body


def test_every_curve_is_drawn_once(tmp_path: Path) -> None:
    found = made_up.unexplained()
    body = _body(_text(found, tmp_path))
    drawn = re.findall(r'<script type="application/json" id="figure-(\d+)">(.*?)</script>', body)
    assert sorted(int(k) for k, _ in drawn) == list(range(len(found.curves)))
    for k, text in drawn:
        assert len(json.loads(text)["data"]) >= len(found.curves[int(k)].traces)


def test_text_of_the_user_cannot_break_the_page(tmp_path: Path) -> None:
    found = made_up.found()
    evil = "</script><script>alert(1)</script>"
    plot = replace(found.curves[0], title=evil, traces=(replace(found.curves[0].traces[0], name=evil),))
    body = _body(_text(replace(found, curves=(plot,), warnings=(evil,), command=evil), tmp_path))
    assert "<script>alert" not in body


def test_a_long_line_keeps_its_spikes() -> None:
    y = np.zeros(200_000)
    y[123_457] = 5.0
    trace = Trace(name="a", role="measured", x=np.arange(200_000.0), y=y)
    plot = Plot(
        slot="response", title="", x_label="", x_unit="s", y_label="", y_unit="rad/s", traces=(trace,)
    )
    import base64

    data = json.loads(figure(plot))["data"][0]["y"]["bdata"]
    values = np.frombuffer(base64.b64decode(data), dtype="<f4")
    assert values.max() == 5.0
    assert len(values) < 10_000


def test_missing_numbers_are_dashes() -> None:
    row = replace(made_up.found().heldout[0], corrected=None, noise_floor=None, gain=None, gain_interval=None)
    assert heldout_table([row]).count("–") == 3
