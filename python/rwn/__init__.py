"""rwn: locate, name, model and prove what a DC-motor drive simulation leaves out."""

from __future__ import annotations

from rwn._core import __version__ as __version__
from rwn.conventional_network import ConventionalNetwork as ConventionalNetwork
from rwn.training import Training as Training
from rwn.wavelets import Wavelet as Wavelet
