from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rwn
from motor_networks import recurrent, relative_error
from rwn import _core
from rwn.networks.rates import Fixed, ImpulseResponse, Normalised, RateRule, Thesis, Tightened
from rwn.reference import recurrent_network as reference

shapes = st.tuples(
    st.integers(1, 3), st.integers(0, 9), st.integers(0, 10**6), st.sampled_from(_core.wavelet_names())
)


def signals(inputs: int, samples: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed + 1)
    t = np.arange(samples)[:, None]
    x = np.sin(t * rng.uniform(0.001, 0.05, inputs) + rng.uniform(0, 6, inputs))
    return x, np.tanh(3 * x.sum(axis=1)) + 0.1 * rng.normal(size=samples)


def loop_gain(network: rwn.RecurrentNetwork) -> float:
    """Largest gain of a wavelet's feedback; above 1 rounding errors may grow with every sample."""
    return float(np.max(np.abs(network.c / network.d), initial=0.0) * network.wavelet.max_derivative)


@pytest.mark.slow
@settings(max_examples=12, deadline=None)
@given(shapes)
def test_training_agrees_with_the_reference(shape: tuple[int, int, int, str]) -> None:
    inputs, wavelets, seed, name = shape
    network = recurrent(inputs, wavelets, seed, name=name)
    x, y = signals(inputs, 1000, seed)
    rates = dict(zip(network.groups, (1e-3, 1e-3, 1e-3, 1e-5, 1e-5, 1e-5), strict=True))
    got = rwn.train_recurrent(network, x, y, rates=Fixed(rates), cycles=2)
    wanted, errors = reference.train(network, x, y, rates=np.array(list(rates.values())), cycles=2)
    assume(loop_gain(wanted) < 1.0)
    assert relative_error(got.network.theta, wanted.theta) < 1e-12
    assert relative_error(got.mse_learning, np.mean(errors**2, axis=1)) < 1e-12
    assert got.mse_frozen[-1] == pytest.approx(wanted.mse(x, y), rel=1e-12)


@pytest.mark.parametrize("name", _core.wavelet_names())
@pytest.mark.parametrize("inputs", [1, 2, 3])
def test_gradients_against_finite_differences(name: str, inputs: int) -> None:
    network = recurrent(inputs, 4, 3, name=name)
    x, _ = signals(inputs, 300, 5)
    _, jacobian = network.sensitivities(x)
    step = 1e-6
    for k in range(len(network.theta)):
        shift = np.zeros_like(network.theta)
        shift[k] = step
        plus, minus = (network.with_theta(network.theta + s * shift).simulate(x) for s in (1, -1))
        difference = (plus - minus) / (2 * step)
        assert np.max(np.abs(jacobian[:, k] - difference)) < 1e-7 * max(1.0, np.max(np.abs(difference)))


def test_without_feedback_it_is_the_static_network() -> None:
    network = recurrent(2, 5, 1)
    static = rwn.RecurrentNetwork(
        **{**{k: getattr(network, k) for k in ("b", "a", "w", "m", "d")}, "c": 0 * network.c}
    )
    x, _ = signals(2, 50, 1)
    order = np.random.default_rng(0).permutation(50)
    np.testing.assert_allclose(static.simulate(x)[order], static.simulate(x[order]), rtol=1e-14)


@pytest.mark.parametrize("rule", [Thesis, Tightened])
def test_the_thesis_bounds_hold(rule: type[Thesis] | type[Tightened]) -> None:
    """Pre-pass bounds against the largest sensitivities met; as printed they hold for max|phi'| <= 1 only."""
    network = recurrent(2, 7, 11)
    x, y = signals(2, 2000, 4)
    run = rwn.train_recurrent(network, x, y, rates=rule(maxima="pre-pass", fraction=1e-9))
    _, jacobian = network.sensitivities(x)
    ends = np.cumsum([1, 2, 7, 14, 14])
    actual = np.array([np.max(np.linalg.norm(part, axis=1)) for part in np.split(jacobian, ends, axis=1)])
    print(
        "bound / actual (b a w m d c):",
        np.round(run.bounds / actual, 2),
        rule.name,
    )
    assert (run.bounds >= actual * (1 - 1e-12)).all()


@pytest.mark.parametrize(
    "rates",
    [
        Thesis(fraction=0.02),
        Tightened(maxima="pre-pass"),
        ImpulseResponse(fraction=0.02),
        Normalised(fraction=0.02),
    ],
)
def test_every_rule_learns_a_static_function(rates: RateRule) -> None:
    x = np.sin(2 * np.pi * np.arange(2000) / 2000)
    y = np.tanh(5 * x)
    network = recurrent(1, 7, 2)
    run = rwn.train_recurrent(network, x, y, rates=rates, cycles=60, frozen_every=30)
    assert run.status == "completed"
    assert run.frozen_after.tolist() == [0, 30, 60]
    assert run.mse_frozen[-1] < 0.1 * run.mse_frozen[0]


def test_a_diverging_run_stops_with_its_status() -> None:
    network = recurrent(1, 3, 0)
    x, y = signals(1, 500, 0)
    run = rwn.train_recurrent(network, x, y, rates=Fixed({"b": 5.0, "a": 5.0}), cycles=10)
    assert run.status == "diverged"
    assert "lower the fraction" in run.advice
    assert np.isfinite(run.network.theta).all()
    assert len(run.mse_learning) < 10


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"d": np.zeros((3, 2))}, "dilation d is 0"),
        ({"m": np.zeros((2, 2))}, r"m must be \(wavelets, inputs\) = \(3, 2\)"),
        ({"a": np.array([])}, "one entry per input"),
        ({"w": np.array([1.0, np.nan, 0.0])}, "w must be finite"),
    ],
)
def test_bad_parameters_are_named(change: dict[str, np.ndarray], message: str) -> None:
    network = recurrent(2, 3, 0)
    good = {k: getattr(network, k) for k in network.groups}
    with pytest.raises(ValueError, match=message):
        rwn.RecurrentNetwork(**{**good, **change})


def test_inputs_of_the_wrong_width_are_named() -> None:
    with pytest.raises(ValueError, match=r"x must have 2 column\(s\)"):
        recurrent(2, 3, 0).simulate(np.zeros((10, 3)))
