"""Panels that several experiments draw."""

from __future__ import annotations

import numpy as np

from rwn.networks.arrays import Array
from rwn.studies.thesis.experiment import Panel, curve


def signal_panel(u: Array, y: Array) -> Panel:
    """Speed and voltage of a recording."""
    t = np.arange(len(y)) * 1e-4
    return Panel(
        xlabel="time [s]", ylabel="speed [rad/s]", curves=[curve(y, t), curve(u, t, label="voltage [V]")]
    )
