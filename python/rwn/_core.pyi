"""
C++ core of rwn; use the classes of the rwn package, which check their input and explain themselves.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
class Wavelet:
    def __init__(self, name: str, omega0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def derivative(self, z: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def second_derivative(self, z: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def value(self, z: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def max_derivative(self) -> float:
        ...
    @property
    def max_scaled_derivative(self) -> float:
        ...
    @property
    def max_value(self) -> float:
        ...
class RecurrentNetwork:
    def __init__(self, theta: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], inputs: typing.SupportsInt | typing.SupportsIndex, wavelet: Wavelet) -> None:
        ...
    def sensitivities(self, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]]:
        ...
    def simulate(self, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    @property
    def theta(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
class StructuredNetwork:
    def __init__(self, theta: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], wavelet: Wavelet) -> None:
        ...
    def sensitivities(self, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]]:
        ...
    def simulate(self, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    @property
    def plant(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 2]"]:
        ...
    @property
    def theta(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
class FixedRates:
    def __init__(self, values: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> None:
        ...
class ThesisRates:
    def __init__(self, *, fraction: typing.SupportsFloat | typing.SupportsIndex, maxima: str, shared: bool, printed: bool) -> None:
        ...
class ImpulseResponseRates:
    def __init__(self, *, fraction: typing.SupportsFloat | typing.SupportsIndex, shared: bool) -> None:
        ...
class NormalisedRates:
    def __init__(self, *, fraction: typing.SupportsFloat | typing.SupportsIndex, regularisation: typing.SupportsFloat | typing.SupportsIndex, scales: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> None:
        ...
class RateReport:
    @property
    def condition(self) -> float:
        ...
    @property
    def defective(self) -> int:
        ...
    @property
    def recurrence(self) -> float:
        ...
    @property
    def recurrent(self) -> int:
        ...
    @property
    def samples(self) -> int:
        ...
    @property
    def smallest_dilation(self) -> float:
        ...
    @property
    def spectral_radius(self) -> float:
        ...
    @property
    def unstable(self) -> int:
        ...
class OnlineHistory:
    @property
    def advice(self) -> str:
        ...
    @property
    def bounds(self) -> list[float]:
        ...
    @property
    def frozen_after(self) -> list[int]:
        ...
    @property
    def mse_frozen(self) -> list[float]:
        ...
    @property
    def mse_learning(self) -> list[float]:
        ...
    @property
    def parameters(self) -> list[list[float]]:
        ...
    @property
    def rates(self) -> list[list[float]]:
        ...
    @property
    def report(self) -> RateReport:
        ...
    @property
    def status(self) -> str:
        ...
def impulse_sums(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 2]"]) -> tuple[float, float]:
    """
    Sums over r of |C A^r e1| and |C A^r e2|.
    """
def isa() -> str:
    """
    Instruction set in use.
    """
def plant_gain(a11: typing.SupportsFloat | typing.SupportsIndex, a12: typing.SupportsFloat | typing.SupportsIndex, a21: typing.SupportsFloat | typing.SupportsIndex, a22: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float]:
    """
    rho(A) and cond(M) in closed form.
    """
def plant_gain_by_eigen(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 2]"]) -> tuple[float, float]:
    """
    rho(A) and cond(M) from Eigen's eigendecomposition.
    """
def rate_rules() -> list[tuple[str, str]]:
    """
    Name and guarantee of every learning-rate rule.
    """
def train_recurrent(network: RecurrentNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], *, rates: FixedRates | ThesisRates | ImpulseResponseRates | NormalisedRates, learn: typing.Annotated[collections.abc.Sequence[bool], "FixedSize(6)"], cycles: typing.SupportsInt | typing.SupportsIndex, frozen_every: typing.SupportsInt | typing.SupportsIndex) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], OnlineHistory]:
    ...
def train_side_by_side(theta: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], wavelet: Wavelet, rates: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"], *, cycles: typing.SupportsInt | typing.SupportsIndex) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]:
    ...
def train_structured(network: StructuredNetwork, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"], *, rates: FixedRates | ThesisRates | ImpulseResponseRates | NormalisedRates, learn: typing.Annotated[collections.abc.Sequence[bool], "FixedSize(9)"], cycles: typing.SupportsInt | typing.SupportsIndex, frozen_every: typing.SupportsInt | typing.SupportsIndex, follow_state: bool) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], OnlineHistory]:
    ...
def wavelet_names() -> list[str]:
    ...
__version__: str = '0.1.0'
