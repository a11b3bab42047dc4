"""
C++ core of rwn; use the classes of the rwn package, which check their input and explain themselves.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
def effect_table() -> list:
    """
    Every effect with its parameters, as the C++ table states them.
    """
def isa() -> str:
    """
    Instruction set in use.
    """
def motor_parameter_table() -> list:
    """
    The motor's own parameters.
    """
def normal_equations(kind: str, time: numpy.typing.NDArray[numpy.float64], input: numpy.typing.NDArray[numpy.float64], parameters: numpy.typing.NDArray[numpy.float64], active: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], by: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], current: numpy.typing.NDArray[numpy.float64], speed: numpy.typing.NDArray[numpy.float64], position: numpy.typing.NDArray[numpy.float64], weights: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"], speed_is_difference: bool = False, angle_per_position: typing.SupportsFloat | typing.SupportsIndex = 1.0, input_before: typing.SupportsFloat | typing.SupportsIndex = 0.0, angle: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ...) -> tuple:
    """
    Free-run output error: status, chi2, count, J'r (p) and J'J (p, p). Empty arrays: not recorded.
    """
def parameter_count() -> int:
    ...
def simulate(kind: str, time: numpy.typing.NDArray[numpy.float64], input: numpy.typing.NDArray[numpy.float64], parameters: numpy.typing.NDArray[numpy.float64], active: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], by: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], angle_per_position: typing.SupportsFloat | typing.SupportsIndex = 1.0, input_before: typing.SupportsFloat | typing.SupportsIndex = 0.0, angle: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ...) -> tuple:
    """
    Returns status, current, speed, position (n) and their derivatives (n, p).
    """
def simulation_advice(arg0: str) -> str:
    ...
def wavelet_names() -> list[str]:
    ...
__version__: str = '0.1.0'
