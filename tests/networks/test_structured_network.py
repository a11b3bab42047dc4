from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rwn
from motor_networks import MOTOR, SAMPLE_TIME, drive, relative_error, structured
from rwn import _core
from rwn.networks.online_training import OnlineTraining
from rwn.networks.rates import Fixed
from rwn.reference import structured_network as reference

RATES = {
    "v1": 1e-6,
    "v2": 1e-6,
    "v3": 1e-7,
    "v4": 1e-8,
    "v5": 1e-8,
    "w": 1e-6,
    "m": 1e-5,
    "d": 1e-5,
    "c": 1e-5,
}
shapes = st.tuples(
    st.integers(0, 40),
    st.integers(0, 10**6),
    st.sampled_from(_core.wavelet_names()),
    st.booleans(),
    st.floats(-0.3, 0.3),
)


@pytest.mark.slow
@settings(max_examples=12, deadline=None)
@given(shapes)
def test_training_agrees_with_the_reference(shape: tuple[int, int, str, bool, float]) -> None:
    wavelets, seed, name, follow, first = shape
    network = structured(wavelets, seed, name=name)
    u, y = drive(1000, frequency=20)

    def trained(first: float) -> OnlineTraining[rwn.StructuredNetwork]:
        return rwn.train_structured(
            network, u, y, learn=network.groups, rates=Fixed(RATES), cycles=2, follow_state=follow, start=(first, 0.1)
        )

    got = trained(first)
    # A training that enlarges a change of its start enlarges rounding as much, and no two programs agree on it.
    nearby = trained(first + 1e-13)
    assume(got.status == nearby.status == "completed")
    assume(relative_error(nearby.network.theta, got.network.theta) < 1e-12)
    start = (first, 0.1)
    rates = np.array(list(RATES.values()))
    wanted, errors = reference.train(network, u, y, rates=rates, cycles=2, follow_state=follow, start=start)
    assert relative_error(got.network.theta, wanted.theta) < 1e-12
    assert relative_error(got.mse_learning, np.mean(errors**2, axis=1)) < 1e-12


@pytest.mark.parametrize("name", _core.wavelet_names())
def test_sensitivities_agree_with_the_reference(name: str) -> None:
    network = structured(15, 7, name=name)
    u, y = drive(1500)
    speed, jacobian = network.sensitivities(u, y)
    wanted_speed, wanted = reference.sensitivities(network, u, y)
    assert relative_error(speed, wanted_speed) < 1e-12
    scale = np.max(np.abs(wanted), axis=0)
    assert np.max(np.abs(jacobian - wanted) / scale) < 1e-12


@pytest.mark.parametrize("name", _core.wavelet_names())
def test_sensitivities_against_finite_differences(name: str) -> None:
    """P of v1..v5 (4.13-4.18, E.2, E.14) and of w, m, d, c (4.21-4.28) by central differences."""
    network = structured(5, 1, name=name)
    u, y = drive(1000, frequency=10)
    _, jacobian = network.sensitivities(u, y)
    for k, value in enumerate(network.theta):
        step = 1e-6 * max(abs(value), 1e-2 if k >= 5 else 0.0)
        plus, minus = network.theta, network.theta
        plus[k] += step
        minus[k] -= step
        difference = (network.with_theta(plus).simulate(u, y) - network.with_theta(minus).simulate(u, y)) / (
            2 * step
        )
        assert np.max(np.abs(jacobian[:, k] - difference)) < 2e-6 * np.max(np.abs(difference)), k


def test_only_the_groups_that_learn_move() -> None:
    network = structured(5, 2)
    u, y = drive(500)
    run = rwn.train_structured(network, u, y, learn=("v2", "d"), rates=Fixed(RATES), cycles=1)
    moved = run.network.theta != network.theta
    assert moved[1]
    assert moved[5 + 2 * 5 : 5 + 3 * 5].all()
    assert moved.sum() == 1 + 5


def test_a_network_of_the_true_motor_simulates_it_exactly() -> None:
    rng = np.random.default_rng(0)
    u = rng.normal(size=400)
    network = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    x, speed = np.zeros(2), []
    for volts in u:
        speed.append(x[0])
        x = network.plant @ x + np.array([0.0, network.v[3] * volts])
    np.testing.assert_allclose(network.simulate(u, np.zeros(400)), speed, rtol=1e-11, atol=1e-14)
    back = network.motor(SAMPLE_TIME)
    for field in back.__dataclass_fields__:
        assert getattr(back, field) == pytest.approx(getattr(MOTOR, field), rel=1e-10)


def test_torque_of_a_recurrent_network() -> None:
    network = structured(4, 3)
    _, y = drive(300)
    run = reference.StructuredRun(network, np.zeros(2))
    wanted = []
    for speed in y:
        run.friction(speed)
        wanted.append(run.torque)
    np.testing.assert_allclose(network.torque(y), wanted, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize(
    ("voltage", "speed", "message"),
    [
        (np.zeros(10), np.zeros(9), "of one length, at least 2 samples; got 10 and 9"),
        (np.zeros(1), np.zeros(1), "at least 2 samples"),
        (np.array([0.0, np.inf]), np.zeros(2), "voltage must be finite"),
        (np.zeros((2, 2)), np.zeros(2), r"voltage must have 1 dimension"),
    ],
)
def test_bad_signals_are_named(voltage: np.ndarray, speed: np.ndarray, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        structured(3, 0).simulate(voltage, speed)


def test_bad_options_are_named() -> None:
    u, y = drive(50)
    network = structured(3, 0)
    with pytest.raises(ValueError, match="got 'v9'"):
        rwn.train_structured(network, u, y, learn=("v9",))
    with pytest.raises(ValueError, match="cycles must be at least 1"):
        rwn.train_structured(network, u, y, learn=("v1",), cycles=0)
    with pytest.raises(ValueError, match="unknown group 'x'"):
        rwn.train_structured(network, u, y, learn=("v1",), rates=Fixed({"x": 1.0}))
    with pytest.raises(ValueError, match="dilation d"):
        network.with_theta(np.zeros(17))
