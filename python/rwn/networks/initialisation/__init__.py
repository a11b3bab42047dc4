"""How a network starts (thesis section 2.2.2); a new way is a file here, and for the conventional network one
entry in a registry."""

from __future__ import annotations

from rwn.networks.initialisation.dyadic_grid import DyadicGrid
from rwn.networks.initialisation.heuristic import Heuristic
from rwn.networks.initialisation.least_squares import LeastSquares
from rwn.networks.initialisation.selection import Selection
from rwn.networks.initialisation.small_random import SmallRandom
from rwn.networks.initialisation.start import Initialiser, LinearStart
from rwn.networks.initialisation.structured_selection import StructuredSelection

INITIALISERS: dict[str, type[Initialiser]] = {way.name: way for way in (Heuristic, DyadicGrid, Selection)}
LINEAR_STARTS: dict[str, type[LinearStart]] = {way.name: way for way in (LeastSquares, SmallRandom)}

__all__ = [
    "INITIALISERS",
    "LINEAR_STARTS",
    "DyadicGrid",
    "Heuristic",
    "Initialiser",
    "LeastSquares",
    "LinearStart",
    "Selection",
    "SmallRandom",
    "StructuredSelection",
]
