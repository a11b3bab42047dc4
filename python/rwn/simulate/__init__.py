"""Free runs of a model over the input of a recording, and the same equations along its motion."""

from __future__ import annotations
