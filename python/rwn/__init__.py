"""rwn: locate, name, model and prove what a DC-motor drive simulation leaves out."""

from __future__ import annotations

from rwn._core import __version__ as __version__
