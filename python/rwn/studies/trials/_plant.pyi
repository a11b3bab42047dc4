"""
The independent plant of the blind trials.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
class Plant:
    """
    The blind trials' motor, one sample at a time.
    """
    def __init__(self, parameters: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex], sample_time: typing.SupportsFloat | typing.SupportsIndex, voltage_scale: typing.SupportsFloat | typing.SupportsIndex, substeps: typing.SupportsInt | typing.SupportsIndex, fineness: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def sample(self) -> typing.Annotated[list[float], "FixedSize(6)"]:
        ...
    @typing.overload
    def step(self, voltage: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @typing.overload
    def step(self, voltage: typing.SupportsFloat | typing.SupportsIndex, instants: typing.SupportsInt | typing.SupportsIndex) -> list[typing.Annotated[list[float], "FixedSize(6)"]]:
        """
        The same; returns (current, speed, position, sensed current, sensed speed, temperature rise) at `instants` even
        places of the step, the first at its beginning.
        """
    def wait(self) -> None:
        ...
    @property
    def substeps(self) -> int:
        ...
def parameter_names() -> list[str]:
    ...
def run(parameters: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex], voltage: numpy.typing.NDArray[numpy.float64], sample_time: typing.SupportsFloat | typing.SupportsIndex, substeps: typing.SupportsInt | typing.SupportsIndex, fineness: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rows of (current, speed, position, sensed current, sensed speed, temperature rise), one per voltage.
    """
