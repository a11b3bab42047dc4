"""
C++ core of rwn; use the classes of the rwn package, which check their input and explain themselves.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
class OwnEffect:
    """
    A user's effect: the term that it changes and the program of its formula.
    """
    def __init__(self, term: str, program: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]], parameters: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def evaluate(self, variables: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(7)"], nominal: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(11)"], parameters: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(8)"]) -> tuple[float, typing.Annotated[list[float], "FixedSize(8)"]]:
        """
        Value, and derivatives by its parameters.
        """
class Work:
    """
    What simulations have cost, counted rather than timed: the same on every machine.
    """
    def __init__(self) -> None:
        ...
    def add(self, units: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    @property
    def done(self) -> int:
        """
        So far; one unit is about a nanosecond of a 4 GHz core.
        """
class Winding:
    """
    A winding under a current [A], a speed [rad/s] and an input [V]: numbers or arrays.
    """
    def __init__(self, *, resistance: typing.SupportsFloat | typing.SupportsIndex, inductance: typing.SupportsFloat | typing.SupportsIndex, torque_constant: typing.SupportsFloat | typing.SupportsIndex, back_emf_constant: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def back_emf(self, speed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        ...
    def braking_rate(self, inertia: typing.SupportsFloat | typing.SupportsIndex) -> float:
        ...
    def heat(self, square: typing.SupportsFloat | typing.SupportsIndex) -> float:
        ...
    def resting_current(self, speed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], input: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        ...
    def resting_voltage(self, current: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        ...
    def torque(self, current: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        ...
class Task:
    """
    What is simulated: a drive, the input of one run, and what its effects follow.
    """
    def __init__(self, drive: str, *, time: numpy.typing.NDArray[numpy.float64], input: numpy.typing.NDArray[numpy.float64], input_time: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., angle_per_position: typing.SupportsFloat | typing.SupportsIndex = 1.0, input_before: typing.SupportsFloat | typing.SupportsIndex = 0.0, angle: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., angle_from_speed: bool = False, angle_from_start: bool = False, restart_every: typing.SupportsInt | typing.SupportsIndex = 0, restart_speed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., restart_position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., order: typing.SupportsInt | typing.SupportsIndex = 0, own: collections.abc.Sequence[OwnEffect] = []) -> None:
        ...
class LeftOver:
    """
    Torque (n) and, where the current was given, voltage (n).
    """
    @property
    def torque(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def voltage(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
class Measurements:
    """
    Recorded signals (n) of one run; empty: not recorded, NaN: does not count.
    """
    def __init__(self, *, current: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., speed: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., weights: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"] = [1.0, 1.0, 1.0], speed_difference: typing.Annotated[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(2)"] = [0, 0], reflection: typing.Annotated[collections.abc.Sequence[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]], "FixedSize(3)"] = [[], [], []]) -> None:
        """
        weights: 1 / standard deviation of current, speed and position; speed_difference: samples before and after between whose positions the speed was taken; reflection: partial autocorrelations of the noise of each, whose errors then count as what is new in them.
        """
class NormalEquations:
    """
    Squared error chi2 over `count` samples, J'r (p) and J'J (p, p).
    """
    @property
    def chi2(self) -> float:
        ...
    @property
    def count(self) -> int:
        ...
    @property
    def curvature(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def gradient(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def status(self) -> str:
        ...
class Simulated:
    """
    Signals (n) [SI] and their derivatives (n, p), by the name of the signal.
    """
    @property
    def signals(self) -> dict:
        ...
    @property
    def slopes(self) -> dict:
        ...
    @property
    def status(self) -> str:
        ...
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
class ConventionalNetwork:
    def __init__(self, wavelet: Wavelet, inputs: typing.SupportsInt | typing.SupportsIndex, wavelets: typing.SupportsInt | typing.SupportsIndex, outputs: typing.SupportsInt | typing.SupportsIndex, parameters: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]) -> None:
        ...
    def gradient(self, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    def jacobian(self, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
    def output(self, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
    @property
    def parameters(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
class Training:
    @property
    def advice(self) -> str:
        ...
    @property
    def frozen_mse(self) -> float:
        ...
    @property
    def mse(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def parameters(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    @property
    def status(self) -> str:
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
    def __init__(self, *, fraction: typing.SupportsFloat | typing.SupportsIndex, maxima: str, shared: bool, misprint: bool, eigen: bool) -> None:
        ...
class TightenedRates:
    def __init__(self, *, fraction: typing.SupportsFloat | typing.SupportsIndex, maxima: str, shared: bool, eigen: bool) -> None:
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
class SideBySide:
    @property
    def advice(self) -> list[str]:
        ...
    @property
    def mse_frozen(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    @property
    def mse_learning(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    @property
    def status(self) -> list[str]:
        ...
    @property
    def theta(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
class StructuredFit:
    @property
    def advice(self) -> str:
        ...
    @property
    def condition(self) -> float:
        ...
    @property
    def deviation(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
    @property
    def mse(self) -> list[float]:
        ...
    @property
    def slope(self) -> float:
        ...
    @property
    def status(self) -> str:
        ...
    @property
    def theta(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
def drive_sites(drive: str) -> set[str]:
    """
    Where effects can attach to a kind of drive, by its name.
    """
def dyadic_grid(x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], wavelets: typing.SupportsInt | typing.SupportsIndex, finest: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]]:
    ...
def effect_table() -> list:
    """
    Every effect with its parameters, as the C++ table states them.
    """
def finest_scale(wavelets: typing.SupportsInt | typing.SupportsIndex) -> tuple[int, int]:
    ...
def first_coefficient() -> int:
    ...
def first_own_parameter() -> int:
    ...
def formula_words() -> dict:
    ...
def gradient_descent(network: ConventionalNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], *, rate: typing.SupportsFloat | typing.SupportsIndex, momentum: typing.SupportsFloat | typing.SupportsIndex, iterations: typing.SupportsInt | typing.SupportsIndex, target: typing.SupportsFloat | typing.SupportsIndex, stall: typing.SupportsFloat | typing.SupportsIndex) -> Training:
    ...
def heuristic(x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], wavelets: typing.SupportsInt | typing.SupportsIndex) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]]:
    ...
def impulse_sums(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 2]"]) -> tuple[float, float]:
    """
    Sums over r of |C A^r e1| and |C A^r e2|.
    """
def innovations(errors: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], reflection: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], restart: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.typing.NDArray[numpy.float64]:
    """
    What is new in errors (n) whose noise has these partial autocorrelations; NaN is passed over.
    """
def isa() -> str:
    """
    Instruction set in use.
    """
def least_squares(x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
    ...
def levenberg_marquardt(network: ConventionalNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], *, mu: typing.SupportsFloat | typing.SupportsIndex, beta: typing.SupportsFloat | typing.SupportsIndex, iterations: typing.SupportsInt | typing.SupportsIndex, target: typing.SupportsFloat | typing.SupportsIndex, stall: typing.SupportsFloat | typing.SupportsIndex) -> Training:
    ...
def motor_parameter_table() -> list:
    """
    The motor's own parameters.
    """
def normal_equations(task: Task, measurements: Measurements, parameters: numpy.typing.NDArray[numpy.float64], active: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], by: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], work: Work | None = None) -> NormalEquations:
    """
    Free-run output error of one run.
    """
def parameter_count() -> int:
    ...
def pattern_descent(network: ConventionalNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], *, rate: typing.SupportsFloat | typing.SupportsIndex, momentum: typing.SupportsFloat | typing.SupportsIndex, shape_momentum: typing.SupportsFloat | typing.SupportsIndex, iterations: typing.SupportsInt | typing.SupportsIndex, target: typing.SupportsFloat | typing.SupportsIndex, stall: typing.SupportsFloat | typing.SupportsIndex) -> Training:
    ...
def pattern_gauss_newton(network: ConventionalNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], *, noise: typing.SupportsFloat | typing.SupportsIndex, weight_prior: typing.SupportsFloat | typing.SupportsIndex, shape_prior: typing.SupportsFloat | typing.SupportsIndex, forgetting: typing.SupportsFloat | typing.SupportsIndex, iterations: typing.SupportsInt | typing.SupportsIndex, target: typing.SupportsFloat | typing.SupportsIndex, stall: typing.SupportsFloat | typing.SupportsIndex) -> Training:
    ...
def plant_gain(a11: typing.SupportsFloat | typing.SupportsIndex, a12: typing.SupportsFloat | typing.SupportsIndex, a21: typing.SupportsFloat | typing.SupportsIndex, a22: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float]:
    """
    rho(A) and cond(M) in closed form.
    """
def plant_gain_by_eigen(a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 2]"]) -> tuple[float, float]:
    """
    rho(A) and cond(M) from Eigen's eigendecomposition.
    """
def rate_defaults() -> dict:
    ...
def rate_rules() -> list[tuple[str, str]]:
    """
    Name and guarantee of every learning-rate rule.
    """
def recursive_gauss_newton(network: StructuredNetwork, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"], *, spread: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], noise: typing.SupportsFloat | typing.SupportsIndex, forgetting: typing.SupportsFloat | typing.SupportsIndex, forgetting_decay: typing.SupportsFloat | typing.SupportsIndex, underweighting: typing.SupportsFloat | typing.SupportsIndex, follow_state: bool, cycles: typing.SupportsInt | typing.SupportsIndex, frozen_every: typing.SupportsInt | typing.SupportsIndex) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], OnlineHistory, typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]:
    ...
def select_wavelets(wavelet: Wavelet, m: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], d: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], wavelets: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
    ...
def simulate(task: Task, parameters: numpy.typing.NDArray[numpy.float64], active: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], by: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], work: Work | None = None) -> Simulated:
    """
    Free run from the input and the start, with derivatives by the parameters `by`.
    """
def simulate_fed_back(network: StructuredNetwork, slope: typing.SupportsFloat | typing.SupportsIndex, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
    """
    Speed of a free run.
    """
def simulate_plant(network: StructuredNetwork, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], torque: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
    """
    Speed for the input and a given friction torque.
    """
def simulation_advice(arg0: str) -> str:
    ...
def special_case_parameters(effect: str, parameters: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> list[float]:
    """
    Parameters of an effect's special case, in the order of the table, from those of the effect.
    """
def structured_levenberg_marquardt(network: StructuredNetwork, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"], *, network_speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], feed: str, current: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], current_weight: typing.SupportsFloat | typing.SupportsIndex, learn: collections.abc.Sequence[bool], iterations: typing.SupportsInt | typing.SupportsIndex, damping: typing.SupportsFloat | typing.SupportsIndex, tolerance: typing.SupportsFloat | typing.SupportsIndex, gauge: bool, weights_first: bool, ridge: typing.SupportsFloat | typing.SupportsIndex) -> StructuredFit:
    ...
def structured_trainer_defaults() -> dict:
    ...
def train_recurrent(network: RecurrentNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], *, rates: FixedRates | ThesisRates | TightenedRates | ImpulseResponseRates | NormalisedRates, learn: typing.Annotated[collections.abc.Sequence[bool], "FixedSize(6)"], cycles: typing.SupportsInt | typing.SupportsIndex, frozen_every: typing.SupportsInt | typing.SupportsIndex) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], OnlineHistory]:
    ...
def train_side_by_side(theta: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], wavelet: Wavelet, rates: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"], *, cycles: typing.SupportsInt | typing.SupportsIndex) -> SideBySide:
    ...
def train_structured(network: StructuredNetwork, input: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], speed: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"], *, rates: FixedRates | ThesisRates | TightenedRates | ImpulseResponseRates | NormalisedRates, learn: typing.Annotated[collections.abc.Sequence[bool], "FixedSize(9)"], cycles: typing.SupportsInt | typing.SupportsIndex, frozen_every: typing.SupportsInt | typing.SupportsIndex, follow_state: bool) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"], OnlineHistory]:
    ...
def trainer_defaults() -> dict:
    ...
def trainer_names() -> list[str]:
    ...
def unknown_inputs(task: Task, parameters: numpy.typing.NDArray[numpy.float64], active: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], *, speed: numpy.typing.NDArray[numpy.float64], position: numpy.typing.NDArray[numpy.float64], acceleration: numpy.typing.NDArray[numpy.float64], current: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ..., current_slope: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = ...) -> LeftOver:
    """
    What the equations leave over along a motion.
    """
def variable_projection(network: ConventionalNetwork, x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], y: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], *, mu: typing.SupportsFloat | typing.SupportsIndex, beta: typing.SupportsFloat | typing.SupportsIndex, resolution: typing.SupportsFloat | typing.SupportsIndex, iterations: typing.SupportsInt | typing.SupportsIndex, target: typing.SupportsFloat | typing.SupportsIndex, stall: typing.SupportsFloat | typing.SupportsIndex) -> Training:
    ...
def wavelet_library(x: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"], levels: typing.SupportsInt | typing.SupportsIndex, zeta: typing.SupportsFloat | typing.SupportsIndex) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"], typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]]:
    ...
def wavelet_names() -> list[str]:
    ...
__version__: str = '0.1.0'
formula_depth: int = 32
max_active_effects: int = 8
max_order: int = 20
max_own_effects: int = 6
max_own_parameters: int = 8
scale_quantities: list = ['torque', 'speed', 'voltage', 'current', 'inertia', 'time_step', 'duration', 'loss']
