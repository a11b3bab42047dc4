"""What is read of a message that holds more than numbers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rwn.errors import InputError
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


def test_a_topic_in_another_encoding_does_no_harm_beside_those_that_are_read(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    writer_of = pytest.importorskip("mcap.writer").Writer
    with path.open("wb") as file:
        writer = writer_of(file)
        writer.start()
        state = writer.register_channel("state", "json", writer.register_schema("State", "jsonschema", b"{}"))
        other = writer.register_channel("/imu", "protobuf", writer.register_schema("Imu", "protobuf", b""))
        for k in range(3):
            writer.add_message(other, k, b"x", k)
            writer.add_message(state, k, json.dumps({"w": k}).encode(), k)
        writer.finish()
    assert FORMATS[".mcap"](path, {"state.w"}).columns["state.w"].tolist() == [0.0, 1.0, 2.0]
    assert set(FORMATS[".mcap"](path, {"x"}).units) == {"state.w"}
    with pytest.raises(InputError, match=r"messages of /imu are in another encoding \(protobuf\); expected ROS 2"):
        FORMATS[".mcap"](path, {"state.w", "/imu.w"})
