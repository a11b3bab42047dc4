"""The TOML text of a model."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from rwn.model.model import Model
from rwn.model.toml_own_effects import to_lines
from rwn.recording.layout import Layout


def format_model(model: Model) -> str:
    """The TOML text of a model, in SI, with units as comments."""
    lines = ["[motor]", f'kind = "{model.kind}"']
    lines += ["linear = true"] if model.linear else []
    lines += model.drive.lines(model.parameters, model.order) or _parameter_lines(model)
    lines += _table("uncertainty", model.uncertainty)
    for name, values in model.effects.items():
        lines += ["", f"[effects.{name}]", *_effect_lines(model, name, values)]
    for effect in model.own_effects:
        lines += to_lines(effect)
    for name, values in model.load.items():
        lines += _table(f"load.{name}", values)
    return "\n".join(lines + _layout_lines(model.recording)) + "\n"


def _parameter_lines(model: Model) -> list[str]:
    return _commented(model.parameters, {name: model.unit(name) for name in model.parameters})


def _effect_lines(model: Model, name: str, values: Mapping[str, float]) -> list[str]:
    effect = model.effect_table[name]
    return _commented(values, {p.name: model.drive.unit_of(effect, p.unit) for p in effect.every})


def _commented(values: Mapping[str, float], units: Mapping[str, str]) -> list[str]:
    """One line a value, the units below one another; none for pure numbers."""
    lines = {name: f"{name} = {float(value)!r}" for name, value in values.items()}
    width = max(map(len, lines.values()), default=0)
    return [
        f"{line:<{width}}  # {units[name]}" if units.get(name, "1") != "1" else line
        for name, line in lines.items()
    ]


def _table(name: str, values: Mapping[str, float]) -> list[str]:
    if not values:
        return []
    return ["", f"[{name}]", *(f"{key} = {float(value)!r}" for key, value in values.items())]


def _layout_lines(layout: Layout) -> list[str]:
    if layout == Layout():
        return []
    lines = ["", "[recording]", f'initial = "{layout.initial}"']
    lines += [] if layout.sample_time is None else [f"sample_time = {layout.sample_time!r}  # s"]
    lines += [] if layout.initial_samples == 20 else [f"initial_samples = {layout.initial_samples}"]
    lines += [] if layout.intersample == "auto" else [f'intersample = "{layout.intersample}"']
    lines += [f"delays.{name} = {delay!r}  # s" for name, delay in layout.delays.items()]
    lines += [f"filters.{name} = {tau!r}  # s" for name, tau in layout.filters.items()]
    for key, seconds in (("from", layout.start), ("to", layout.end)):
        lines += [] if seconds is None else [f"{key} = {seconds!r}  # s"]
    lines += [] if layout.decimate == 1 else [f"decimate = {layout.decimate}"]
    lines += [] if layout.speed_rows is None else [f"speed_rows = {list(layout.speed_rows)}"]
    lines += [] if layout.profile is None else [f'profile = "{layout.profile}"']
    for name, column in layout.columns.items():
        items = [f"source = {_quoted(column.source)}"]
        items += [] if column.unit is None else [f"unit = {_quoted(column.unit)}"]
        scale = f'"{column.scale!r} {column.scale_unit}"' if column.scale_unit else repr(column.scale)
        items += [] if column.scale == 1.0 and not column.scale_unit else [f"scale = {scale}"]
        lines.append(f"columns.{name} = {{ {', '.join(items)} }}")
    return lines


def _quoted(text: str) -> str:
    return msgspec.json.encode(text).decode()
