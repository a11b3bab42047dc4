"""Draws figures with matplotlib (extra `thesis`)."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from rwn.studies.thesis.experiment import Figure, Panel, Surface


def draw(figures: Iterable[Figure], folder: Path) -> list[Path]:
    """Draws each as a PNG of 800 pixels' width; returns their paths. Raises ModuleNotFoundError without
    matplotlib."""
    import matplotlib

    matplotlib.use("Agg")
    folder.mkdir(parents=True, exist_ok=True)
    return [_draw(figure, folder / f"{figure.stem}.png") for figure in figures]


def _draw(figure: Figure, path: Path) -> Path:
    import matplotlib.pyplot as plt

    count = len(figure.panels)
    columns = 1 if count == 1 else 2
    rows = -(-count // columns)
    sheet = plt.figure(figsize=(8, 4.6 if count <= 2 else 3.2 * rows), dpi=100, layout="constrained")
    for place, panel in enumerate(figure.panels, start=1):
        solid = panel.surface is not None and not panel.surface.flat
        axes = sheet.add_subplot(rows, columns, place, projection="3d" if solid else None)
        _fill(axes, panel)
    label = f"Figure {figure.number}: " if figure.number is not None else ""
    sheet.suptitle(label + figure.title, fontsize=11)
    sheet.savefig(path)
    plt.close(sheet)
    return path


def _fill(axes: Any, panel: Panel) -> None:
    axes.set(xlabel=panel.xlabel, ylabel=panel.ylabel, title=panel.title)
    if panel.surface is not None:
        _fill_surface(axes, panel.surface)
        return
    for line in panel.curves:
        beside = line.style == ":" and not line.label and axes.lines  # the range of the curve before it
        same = {"color": axes.lines[-1].get_color(), "alpha": 0.6} if beside else {}
        axes.plot(line.x, line.y, line.style, label=line.label or None, linewidth=1.3, **same)
    drawn = {line.get_label(): line.get_color() for line in axes.lines}
    for k, (label, value) in enumerate(panel.thesis.items()):
        colour = drawn.get(label, f"C{k}")
        axes.axhline(value, color=colour, linestyle=(0, (1, 3)), linewidth=1.6, label=f"thesis: {label}")
    if panel.log_x:
        axes.set_xscale("log")
    if panel.log_y:
        axes.set_yscale("log")
    if panel.thesis or any(line.label for line in panel.curves):
        axes.legend(fontsize=8)
    axes.grid(alpha=0.3)


def _fill_surface(axes: Any, surface: Surface) -> None:
    x, y, z = np.array(surface.x), np.array(surface.y), np.array(surface.z)
    if surface.flat:
        low, high = surface.limits or (None, None)
        image = axes.pcolormesh(
            x, y, np.log10(z) if surface.log else z, shading="nearest", cmap="viridis", vmin=low, vmax=high
        )
        axes.figure.colorbar(image, ax=axes, label=surface.label)
    else:
        axes.plot_surface(*np.meshgrid(x, y), z, cmap="viridis", linewidth=0)
        axes.set_zlabel(surface.label)
