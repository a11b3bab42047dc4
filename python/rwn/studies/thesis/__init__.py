"""The experiments of Zahidi's thesis, repeated with this package: `rwn thesis run --all`.

An experiment is one file here and one entry in `rwn.studies.thesis.registry`.
"""

from __future__ import annotations
