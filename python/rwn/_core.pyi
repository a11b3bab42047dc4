"""
C++ core of rwn; use the classes of the rwn package, which check their input and explain themselves.
"""
from __future__ import annotations
def isa() -> str:
    """
    Instruction set in use.
    """
def wavelet_names() -> list[str]:
    ...
__version__: str = '0.1.0'
