from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rwn
from motor_networks import MOTOR, SAMPLE_TIME, drive, recurrent, structured
from rwn import _core
from rwn.networks.rates import (
    GUARANTEES,
    RATES,
    Fixed,
    ImpulseResponse,
    Normalised,
    RateRule,
    Thesis,
    Tightened,
)
from rwn.reference import rates as reference

ALL = rwn.StructuredNetwork.groups
entries = st.floats(-2, 2, allow_subnormal=False)


@settings(max_examples=300, deadline=None)
@given(entries, entries, entries, entries)
def test_the_closed_form_equals_eigens_decomposition(a11: float, a12: float, a21: float, a22: float) -> None:
    A = np.array([[a11, a12], [a21, a22]])
    eigenvalues = np.linalg.eigvals(A)
    assume(abs(eigenvalues[0] - eigenvalues[1]) > 1e-4 * np.abs(A).max() + 1e-9)
    radius, condition = _core.plant_gain(a11, a12, a21, a22)
    eigen_radius, eigen_condition = _core.plant_gain_by_eigen(A)
    assert radius == pytest.approx(eigen_radius, rel=1e-10)
    assert condition == pytest.approx(eigen_condition, rel=1e-7)


@pytest.mark.parametrize("kind", ["complex", "real", "identity", "defective", "rotation"])
def test_the_closed_form_at_special_matrices(kind: str) -> None:
    A = {
        "complex": np.array([[0.99, 0.03], [-0.007, 0.95]]),
        "real": np.array([[0.7, 0.03], [-0.007, 0.95]]),
        "identity": 0.5 * np.eye(2),
        "defective": np.array([[0.5, 1.0], [0.0, 0.5]]),
        "rotation": np.array([[0.0, 0.9], [-0.9, 0.0]]),
    }[kind]
    radius, condition = _core.plant_gain(*A.ravel())
    assert radius == pytest.approx(np.abs(np.linalg.eigvals(A)).max(), rel=1e-9)
    if kind == "defective":
        assert condition == np.inf
    else:
        assert condition == pytest.approx(_core.plant_gain_by_eigen(A)[1], rel=1e-9)


def test_the_condition_near_repeated_eigenvalues() -> None:
    """Within 1e-6 of the viscous friction at which eigenvalues meet both still agree."""
    t, J, R, L, K = SAMPLE_TIME, 1.8e-4, 0.4, 0.8e-3, 0.055
    for sign in (-1, 1):
        meeting = J * (R / L + sign * 2 * K / np.sqrt(J * L))
        for offset in (1e-2, 1e-4, 1e-6):
            A = np.array([[1 - meeting * (1 + offset) * t / J, t / J * K], [-K * t / L, 1 - R * t / L]])
            assert _core.plant_gain(*A.ravel())[1] == pytest.approx(_core.plant_gain_by_eigen(A)[1], rel=1e-4)


def test_impulse_sums_against_a_direct_sum() -> None:
    A = structured(0, 0).plant
    row, total = np.array([1.0, 0.0]), np.zeros(2)
    for _ in range(20000):
        total += np.abs(row)
        row = row @ A
    np.testing.assert_allclose(_core.impulse_sums(A), total, rtol=1e-12)
    assert _core.impulse_sums(np.array([[1.0, 0.1], [0.0, 0.5]])) == (np.inf, np.inf)


def largest_sensitivities(network: rwn.StructuredNetwork, u: np.ndarray, y: np.ndarray) -> np.ndarray:
    _, jacobian = network.sensitivities(u, y)
    parts = np.split(jacobian, np.cumsum([1, 1, 1, 1, 1] + [network.wavelets] * 3), axis=1)
    return np.array([np.max(np.linalg.norm(part, axis=1)) for part in parts])


@pytest.mark.parametrize("name", _core.wavelet_names())
@pytest.mark.parametrize("viscous", [0.0, 0.06, 0.3])
@pytest.mark.parametrize("rule", ["thesis", "tightened", "impulse-response"])
def test_bounds_are_not_below_the_actual_maxima(name: str, viscous: float, rule: str) -> None:
    """The thesis's constants, 1, bound the Gaussian derivative only."""
    if rule == "thesis" and name != "gaussian-derivative":
        pytest.skip("max|phi'| is 1.38 and 4.79, not 1")
    network = structured(7, 5, name=name)
    v = network.v.copy()
    v[0] = viscous
    network = rwn.StructuredNetwork(
        v=v, w=network.w, m=network.m, d=network.d, c=network.c, wavelet=network.wavelet
    )
    u, y = drive(3000)
    tiny: dict[str, RateRule] = {
        "thesis": Thesis(fraction=1e-12, maxima="pre-pass"),
        "tightened": Tightened(fraction=1e-12, maxima="pre-pass"),
        "impulse-response": ImpulseResponse(fraction=1e-12),
    }
    rates = tiny[rule]
    bounds = rwn.train_structured(network, u, y, learn=ALL, rates=rates).bounds
    ratio = bounds / largest_sensitivities(network, u, y)
    print(f"{rule} {name} B={viscous}: bound/actual v1..v5 w m d c =", np.round(ratio, 2))
    assert (ratio >= 1 - 1e-12).all()


def test_the_bound_of_v3_as_printed_is_below_the_actual_maximum() -> None:
    """The erratum of (4.66-4.75): |v3||x2| for |v2||x2| makes the 'bound' too small where v2 > v3."""
    network = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    t = np.arange(10000) * SAMPLE_TIME
    u = np.sin(2 * np.pi * 2 * t**2)
    y = network.simulate(u, np.zeros(10000))
    actual = largest_sensitivities(network, u, y)[2]
    for misprint, holds in ((True, False), (False, True)):
        rule = Thesis(fraction=1e-12, maxima="pre-pass", misprint=misprint)
        bound = rwn.train_structured(network, u, y, learn=("v3",), rates=rule).bounds[2]
        print(f"misprint={misprint}: bound/actual of v3 = {bound / actual:.3f}")
        assert (bound >= actual) == holds


RULES = {
    "thesis": Thesis(fraction=1e-4),
    "misprint": Thesis(fraction=1e-4, misprint=True),
    "tightened": Tightened(fraction=1e-4),
    "eigen": Thesis(fraction=1e-4, eigen=True),
}


@pytest.mark.parametrize("wavelets", [0, 5, 15])
@pytest.mark.parametrize("kind", RULES)
@pytest.mark.parametrize("name", _core.wavelet_names())
def test_the_thesis_rule_agrees_with_the_reference(wavelets: int, kind: str, name: str) -> None:
    """Every group learns, the electrical ones of Appendix E too."""
    network = structured(wavelets, 4, name=name)
    u, y = drive(1200, frequency=10)
    rule = RULES[kind]
    got = rwn.train_structured(network, u, y, learn=ALL, rates=rule)
    wanted, bounds = reference.train_thesis(network, u, y, learn=ALL, rule=rule)
    np.testing.assert_allclose(got.bounds, bounds, rtol=1e-11)
    np.testing.assert_allclose(got.network.theta, wanted.theta, rtol=1e-11, atol=1e-15)
    moved = np.abs(wanted.theta - network.theta)
    assert (moved[:5] > 0).all()


@pytest.mark.parametrize("shape", [(1, 3), (1, 15), (2, 7), (3, 5), (5, 3)])
@pytest.mark.parametrize("kind", ["thesis", "tightened"])
@pytest.mark.parametrize("name", _core.wavelet_names())
def test_the_rates_of_chapter_3_agree_with_the_reference(shape: tuple[int, int], kind: str, name: str) -> None:
    network = recurrent(*shape, 6, name=name)
    x = np.sin(np.arange(400)[:, None] * np.linspace(0.01, 0.04, shape[0]) + np.arange(shape[0]))
    y = np.tanh(2 * x.sum(axis=1))
    rule = RULES[kind]
    got = rwn.train_recurrent(network, x, y, rates=rule)
    wanted, bounds = reference.train_thesis_recurrent(network, x, y, learn=network.groups, rule=rule)
    np.testing.assert_allclose(got.bounds, bounds, rtol=1e-12)
    np.testing.assert_allclose(got.network.theta, wanted.theta, rtol=1e-11, atol=1e-15)
    assert (got.network.theta != network.theta).all()


@pytest.mark.parametrize("wavelets", [1, 8, 15])
def test_the_report_knows_the_smallest_dilation(wavelets: int) -> None:
    """Lanes that fill a vector up are no wavelets."""
    w = np.full(wavelets, 1e-3)
    network = rwn.StructuredNetwork.from_motor(
        MOTOR, sample_time=SAMPLE_TIME, w=w, m=0 * w, d=5 + 0 * w, c=0 * w
    )
    u, y = drive(200)
    report = rwn.train_structured(network, u, y, learn=("w",), rates=Thesis(fraction=1e-9)).report
    assert report.smallest_dilation == pytest.approx(5.0)
    other = rwn.RecurrentNetwork(
        b=0.0, a=[0.0], w=w, m=0 * w[:, None], d=5 + 0 * w[:, None], c=0 * w[:, None]
    )
    report = rwn.train_recurrent(other, y, y, rates=Thesis(fraction=1e-9)).report
    assert report.smallest_dilation == pytest.approx(5.0)


@pytest.mark.parametrize("follow", [True, False])
def test_the_normalised_rule_agrees_with_the_reference(follow: bool) -> None:
    network = structured(5, 4)
    u, y = drive(1000, frequency=10)
    scales = {"v1": 0.05, "v2": 0.1, "w": 0.01, "m": 0.05}
    rule = Normalised(fraction=0.1, scales=scales)
    got = rwn.train_structured(network, u, y, learn=tuple(scales), rates=rule, follow_state=follow)
    wanted = reference.train_normalised(network, u, y, rule=rule, follow_state=follow)
    np.testing.assert_allclose(got.network.theta, wanted.theta, rtol=1e-11, atol=1e-15)


def test_the_impulse_response_rates_agree_with_the_reference() -> None:
    network = structured(5, 4)
    u, y = drive(1500)
    run = rwn.train_structured(network, u, y, learn=ALL, rates=ImpulseResponse())
    np.testing.assert_allclose(run.rates[0], reference.impulse_response(network, u, y), rtol=1e-10)


def test_every_rule_is_registered_and_states_its_guarantee() -> None:
    assert set(RATES) == set(GUARANTEES)
    assert all(len(text) > 40 for text in GUARANTEES.values())


def test_the_report_names_a_defective_plant() -> None:
    """At the viscous friction where eigenvalues meet, the printed bound freezes learning and says so."""
    B = 1.8e-4 * (0.4 / 0.8e-3 - 2 * 0.055 / np.sqrt(1.8e-4 * 0.8e-3))
    motor = rwn.MotorParameters(
        resistance=0.4, inductance=0.8e-3, torque_constant=0.055, inertia=1.8e-4, viscous_friction=B
    )
    network = rwn.StructuredNetwork.from_motor(motor, sample_time=SAMPLE_TIME)
    u, y = drive(500)
    run = rwn.train_structured(network, u, y, learn=("v2",), rates=Thesis(fraction=1e-3))
    assert run.report.condition > 1e7
    tight = rwn.train_structured(network, u, y, learn=("v2",), rates=ImpulseResponse())
    assert tight.rates[0, 1] > 1e10 * run.rates[0, 1]


def test_the_report_names_an_unstable_plant_and_does_not_learn_from_it() -> None:
    network = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    v = network.v.copy()
    v[0] = -0.02
    u, y = drive(300)
    run = rwn.train_structured(
        rwn.StructuredNetwork(v=v, w=[], m=[], d=[], c=[]), u, y, learn=("v2", "v3"), rates=Thesis()
    )
    assert run.status == "unstable"
    assert run.report.unstable >= 299
    assert any("rho(A)" in warning for warning in run.report.warnings)
    np.testing.assert_array_equal(run.network.v, v)


def test_the_report_names_feedback_that_is_too_strong() -> None:
    network = structured(3, 0)
    network = rwn.StructuredNetwork(v=network.v, w=network.w, m=network.m, d=network.d, c=1.5 * network.d)
    u, y = drive(300)
    run = rwn.train_structured(network, u, y, learn=("w", "c"), rates=Thesis(fraction=1e-3))
    assert run.report.recurrent == 299
    assert any("|c/d|" in warning for warning in run.report.warnings)


def test_a_diverging_run_returns_finite_parameters_and_advice() -> None:
    network = structured(5, 0)
    u, y = drive(2000)
    run = rwn.train_structured(network, u, y, learn=ALL, rates=Fixed(dict.fromkeys(ALL, 10.0)), cycles=20)
    assert run.status == "diverged"
    assert np.isfinite(run.network.theta).all()
    assert np.isfinite(run.mse_frozen).all()
    assert "recursive Gauss-Newton" in run.advice


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Thesis(fraction=0.0), "fraction must be positive"),
        (lambda: Thesis(maxima="never"), "maxima must be running"),  # type: ignore[arg-type]
        (lambda: Normalised(regularisation=-1), "regularisation must be positive"),
        (lambda: ImpulseResponse(fraction=-1.0), "fraction must be positive"),
    ],
)
def test_bad_options_are_named(make: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()  # type: ignore[operator]
