"""What is read of a message that holds more than numbers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rwn.recording.formats import FORMATS


def test_numbers_in_a_list_have_their_place_and_images_none(tmp_path: Path) -> None:
    writer_of = pytest.importorskip("mcap.writer").Writer
    with (tmp_path / "a.mcap").open("wb") as file:
        writer = writer_of(file)
        writer.start()
        channel = writer.register_channel("state", "json", writer.register_schema("State", "jsonschema", b"{}"))
        for k in range(3):
            writer.add_message(channel, k, json.dumps({"w": [k, {"fine": 2.0 * k}], "image": [0] * 99}).encode(), k)
        writer.finish()
    table = FORMATS[".mcap"](tmp_path / "a.mcap", {"state.w[0]", "state.w[1].fine"})
    assert table.columns["state.w[1].fine"].tolist() == [0.0, 2.0, 4.0]
    assert set(table.units) == {"time", "state.w[0]", "state.w[1].fine"}
