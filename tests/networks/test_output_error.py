"""The structured network fed with the speed that it simulates itself: exactness, and what that cures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rwn
from motor_networks import MOTOR, SAMPLE_TIME, drive, friction, structured
from rwn.networks.trainers import StructuredLevenbergMarquardt
from rwn.reference.structured_network import free_run

LEARN = ("v1", "v2", "w", "m", "d")


def static(wavelets: int, seed: int) -> rwn.StructuredNetwork:
    """A random network without feedback."""
    made = structured(wavelets, seed)
    return rwn.StructuredNetwork(v=made.v, w=made.w, m=made.m, d=made.d, c=0 * made.c)


def wrong(network: rwn.StructuredNetwork) -> rwn.StructuredNetwork:
    """J 10 % low, B 10 % high, every wavelet a little elsewhere."""
    v = network.v * np.array([1.1, 1.1, 1, 1, 1])
    return rwn.StructuredNetwork(
        v=v, w=0.9 * network.w, m=network.m + 0.03, d=1.1 * network.d, c=network.c
    )


@pytest.mark.parametrize("slope", [0.0, 0.02])
def test_the_free_run_agrees_with_the_reference(slope: float) -> None:
    network = static(6, 2)
    u, _ = drive(3000, frequency=10)
    fit = StructuredLevenbergMarquardt(iterations=0, gauge=False, weights_first=False).fit(
        network, u, u, learn=("v1",)
    )
    got = replace(fit, slope=slope).free_run(u)
    np.testing.assert_allclose(got, free_run(network, slope, u), rtol=1e-11, atol=1e-12)


@pytest.mark.parametrize("gauge", [False, True])
def test_the_true_network_is_found_from_its_own_free_run(gauge: bool) -> None:
    """Converges to rounding, which a wrong derivative through the simulated speed would not allow."""
    network = static(3, 5)
    u, _ = drive(4000, frequency=6)
    y = free_run(network, 0.0, u)
    trainer = StructuredLevenbergMarquardt(iterations=60, gauge=gauge, weights_first=False)
    groups = ("v2", "w", "m", "d") if not gauge else LEARN
    begun = wrong(network)
    if not gauge:  # B stays: it and the network share the slope
        begun = rwn.StructuredNetwork(
            v=network.v * np.array([1, 1.1, 1, 1, 1]), w=begun.w, m=begun.m, d=begun.d, c=begun.c
        )
    fit = trainer.fit(begun, u, y, learn=groups, feed="simulated")
    assert fit.mse[-1] < 1e-20
    np.testing.assert_allclose(fit.network.v[1], network.v[1], rtol=1e-7)
    np.testing.assert_allclose(fit.friction(y), network.torque(y) + 0.06 * y, atol=1e-8)


def noisy_fit(seed: int, feed: str) -> float:
    """Error of J in percent, at 30 dB, by the speed that feeds the network."""
    u, y = drive(5000)
    sigma = float(np.sqrt(np.mean(y**2))) * 10**-1.5
    measured = y + sigma * np.random.default_rng(seed).normal(size=len(y))
    smooth = np.convolve(np.pad(measured, 20, mode="edge"), np.full(41, 1 / 41), mode="valid")
    half = np.geomspace(0.05, 1.4, 6)
    m = np.concatenate([-half[::-1], [0.0], half])
    motor = replace(MOTOR, inertia=2.16e-4, viscous_friction=0.048)
    network = rwn.StructuredNetwork.from_motor(
        motor, sample_time=SAMPLE_TIME, w=0 * m, m=m, d=np.gradient(m), c=0 * m
    )
    trainer = StructuredLevenbergMarquardt(iterations=30, tolerance=1e-6, ridge=sigma / 0.1)
    groups = ("v1", "v2", "w")
    if feed == "measured":
        fit = trainer.fit(network, u, measured, learn=groups)
    else:
        first = trainer.fit(network, u, measured, learn=groups, network_speed=smooth)
        fit = replace(trainer, weights_first=False).fit(
            first.network, u, measured, learn=groups, network_speed=smooth, feed="simulated"
        )
    return 100 * (fit.network.motor(SAMPLE_TIME).inertia / MOTOR.inertia - 1)


def test_the_simulated_speed_takes_the_bias_of_a_noisy_input_away() -> None:
    """Errors in variables: fed with the measured speed, J is off by far more than its scatter; seeds are a sample."""
    measured = np.array([noisy_fit(seed, "measured") for seed in range(6)])
    simulated = np.array([noisy_fit(seed, "simulated") for seed in range(6)])
    scatter = simulated.std(ddof=1) / np.sqrt(6)
    print(f"bias of J: measured {measured.mean():+.2f} %, simulated {simulated.mean():+.2f} +- {scatter:.2f} %")
    assert measured.mean() > 3.0
    assert abs(simulated.mean()) < max(3 * scatter, 0.2 * measured.mean())


def test_the_ridge_keeps_weights_small() -> None:
    u, y = drive(3000)
    m = np.linspace(-1, 1, 25)
    network = rwn.StructuredNetwork.from_motor(
        MOTOR, sample_time=SAMPLE_TIME, w=0 * m, m=m, d=0 * m + 0.3, c=0 * m
    )
    sizes = [
        float(np.abs(StructuredLevenbergMarquardt(ridge=r).fit(network, u, y, learn=("w",)).network.w).max())
        for r in (0.0, 0.1, 10.0)
    ]
    assert sizes[0] > sizes[1] > sizes[2] > 0


def test_with_the_current_the_variance_counts_both_rows() -> None:
    """White noise on both: stated deviations match the scatter over seeds within the error of 40 draws (11 %)."""
    u, _ = drive(3000, frequency=20)
    true = rwn.StructuredNetwork.from_motor(MOTOR, sample_time=SAMPLE_TIME)
    x, speed, current = np.zeros(2), np.empty(len(u)), np.empty(len(u))
    for n, volts in enumerate(u):
        speed[n], current[n] = x
        x = true.plant @ x + np.array([0.0, true.v[3] * volts])
    errors = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        fit = StructuredLevenbergMarquardt(gauge=False, tolerance=1e-8).fit(
            true,
            u,
            speed + 0.01 * rng.normal(size=len(u)),
            learn=("v1", "v2", "v3"),
            current=current + 0.05 * rng.normal(size=len(u)),
            current_weight=0.2,
        )
        errors.append((fit.network.v - true.v)[:3] / fit.deviation[:3])
    spread = np.sqrt(np.mean(np.square(errors), axis=0))
    assert (np.abs(spread - 1) < 0.4).all(), spread


def test_what_cannot_be_fed_back_is_named() -> None:
    network = structured(3, 1)
    u, y = drive(500)
    with pytest.raises(ValueError, match="must be static, c = 0"):
        StructuredLevenbergMarquardt().fit(network, u, y, learn=("w",), feed="simulated")
    with pytest.raises(ValueError, match="expected 'measured' or 'simulated', got 'other'"):
        StructuredLevenbergMarquardt().fit(network, u, y, learn=("w",), feed="other")  # type: ignore[arg-type]


def test_friction_is_that_of_the_motor() -> None:
    """The free run of a fit to the motor with friction follows it on a voltage it has not seen."""
    u, y = drive(8000)
    half = np.geomspace(0.05, 1.4, 10)
    m = np.concatenate([-half[::-1], [0.0], half])
    network = rwn.StructuredNetwork.from_motor(
        MOTOR, sample_time=SAMPLE_TIME, w=0 * m, m=m, d=np.gradient(m), c=0 * m
    )
    fit = StructuredLevenbergMarquardt(iterations=30).fit(network, u, y, learn=("v1", "w"))
    other, speed = drive(8000, amplitude=0.8)
    assert float(np.sqrt(np.mean((fit.free_run(other) - speed) ** 2))) < 0.01 * float(np.std(speed))
    assert float(np.max(np.abs(friction(y)))) > 0.04
