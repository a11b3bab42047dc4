"""A picture of the mismatch, for who reads the report: where its energy lies and what it depends on.

It is made once the rest is decided; naming looks at the residuals themselves (`rwn.name.initial_guesses`).
"""

from __future__ import annotations
