"""Every imperfection does to a recording what it says."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rwn.studies.trials.bench import Noise, Recording
from rwn.studies.trials.bench_trials.imperfections import KINDS, Imperfection, Instruments, draw, exclude
from rwn.studies.trials.bench_trials.imperfections.coloured_noise import ColouredNoise
from rwn.studies.trials.bench_trials.imperfections.converter import ClippedCurrent, CoarseConverter
from rwn.studies.trials.bench_trials.imperfections.drive_filter import DriveFilter
from rwn.studies.trials.bench_trials.imperfections.encoder_difference import EncoderDifference
from rwn.studies.trials.bench_trials.imperfections.gain_error import GainError
from rwn.studies.trials.bench_trials.imperfections.held import Held
from rwn.studies.trials.bench_trials.imperfections.hum import Hum
from rwn.studies.trials.bench_trials.imperfections.jitter import Jitter, ResampledJitter
from rwn.studies.trials.bench_trials.imperfections.late_channel import LateChannel
from rwn.studies.trials.bench_trials.imperfections.late_enable import LateEnable
from rwn.studies.trials.bench_trials.imperfections.lost_rows import LostRows
from rwn.studies.trials.bench_trials.imperfections.noisy_voltage import NoisyVoltage
from rwn.studies.trials.bench_trials.imperfections.spikes import Spikes
from rwn.studies.trials.bench_trials.imperfections.stamps import FastClock, RoundedTime
from rwn.studies.trials.bench_trials.imperfections.starts_in_motion import StartsInMotion
from rwn.studies.trials.bench_trials.imperfections.thinned import Thinned
from rwn.studies.trials.bench_trials.imperfections.uneven_friction import UnevenFriction
from rwn.studies.trials.bench_trials.imperfections.zero_offset import ZeroOffset
from rwn.studies.trials.bench_trials.logger import Logger
from rwn.studies.trials.bench_trials.rig import Truth
from rwn.studies.trials.judges import FINE
from rwn.studies.trials.plant import Array

RATE, TICKS = 1000.0, 2000
QUIET = Noise(0.0, 0.0)
NOISE = Noise(0.1, 0.02)
INSTRUMENTS = Instruments(signals=("V", "i", "w", "th"), encoder=False, rate=RATE, coarse=False, recordings=3)
STREAM = (1, 2, 3)


def true_speed(time: Array) -> Array:
    return 50.0 * np.sin(2.0 * np.pi * time)


def true_current(time: Array) -> Array:
    return 2.0 * np.cos(2.0 * np.pi * time)


def a_truth() -> Truth:
    """A sine of 1 Hz; the voltage counts the ticks."""
    fine = np.arange(TICKS * FINE + 1) / (RATE * FINE)
    speed, current = true_speed(fine), true_current(fine)
    position = 50.0 / (2.0 * np.pi) * (1.0 - np.cos(2.0 * np.pi * fine))
    states = np.column_stack([current, speed, position, current, speed, 0.0 * fine])
    return Truth(rate=RATE, voltage=np.arange(TICKS, dtype=np.float64), states=states)


def recorded(*chain: Imperfection, noise: Noise = QUIET, clean: bool = False) -> Recording:
    peaks = {"speed": 50.0, "current": 2.0, "voltage": float(TICKS)}
    logger = Logger(imperfections=chain, noise=noise, signals=("V", "i", "w", "th"), peaks=peaks)
    return (logger.without_noise() if clean else logger).record(a_truth(), STREAM)


def current_of(recording: Recording) -> Array:
    assert recording.current is not None
    return recording.current


def test_without_imperfections_the_rows_are_true() -> None:
    plain = recorded()
    np.testing.assert_allclose(plain.speed, true_speed(plain.time), atol=1e-9)
    np.testing.assert_allclose(current_of(plain), true_current(plain.time), atol=1e-9)
    np.testing.assert_array_equal(plain.voltage, np.arange(TICKS))


def test_gain_and_offset() -> None:
    off = recorded(GainError(speed=0.01, current=-0.02, stated=0.01))
    np.testing.assert_allclose(off.speed, 1.01 * true_speed(off.time), atol=1e-9)
    np.testing.assert_allclose(current_of(off), 0.98 * true_current(off.time), atol=1e-9)
    assert GainError(speed=0.01, current=0.0, stated=0.01).declared() == {"gain_uncertainty": 0.01}
    shifted = recorded(ZeroOffset(speed=2.0, current=-3.0), noise=NOISE)
    assert np.mean(shifted.speed - true_speed(shifted.time)) == pytest.approx(0.2, abs=0.02)
    assert np.mean(current_of(shifted) - true_current(shifted.time)) == pytest.approx(-0.06, abs=0.005)


def test_filter_lags_by_its_time_constant() -> None:
    filtered = recorded(DriveFilter(speed=4.0, current=2.0))
    later = slice(100, None)
    np.testing.assert_allclose(
        filtered.speed[later], true_speed(filtered.time[later] - 3.5e-3), atol=0.3
    )  # a discrete filter of 4 samples: a lag of 1 / (exp(1/4) - 1) = 3.5
    np.testing.assert_allclose(current_of(filtered)[later], true_current(filtered.time[later] - 1.54e-3), atol=0.01)


@pytest.mark.parametrize(("window", "filter_"), [(4, 0.0), (0, 2.0)])
def test_encoder_difference_counts_and_lags(window: int, filter_: float) -> None:
    counting = EncoderDifference(counts=2000, window=window, filter=filter_)
    seen, exact = recorded(counting), recorded(counting, clean=True)
    lag = 0.5e-3 + ((window - 1) / 2.0e3 if window else 1e-3 / (np.exp(0.5) - 1.0))
    np.testing.assert_allclose(exact.speed[50:], true_speed(exact.time[50:] - lag), atol=0.1)
    error = float(np.sqrt(np.mean((seen.speed - exact.speed)[50:] ** 2)))
    assert error == pytest.approx(counting.speed_error(RATE), rel=0.3)
    step = 2.0 * np.pi / 2000
    np.testing.assert_allclose(seen.position / step, np.round(seen.position / step), atol=1e-6)  # type: ignore[operator]


def test_held_values_repeat() -> None:
    held = recorded(Held(speed=5, current=1))
    assert np.count_nonzero(np.diff(held.speed)) <= TICKS // 5
    np.testing.assert_array_equal(held.speed[1:5], np.full(4, held.speed[0]))
    assert np.count_nonzero(np.diff(current_of(held))) > TICKS // 2


def test_coarse_and_clipping_converters() -> None:
    coarse = recorded(CoarseConverter(speed_bits=8, current_bits=0, full_scale=1.28))
    step = 2.0 * 1.28 * 50.0 / 256.0
    np.testing.assert_allclose(coarse.speed / step, np.round(coarse.speed / step), atol=1e-9)
    assert np.max(np.abs(coarse.speed - true_speed(coarse.time))) <= 0.5 * step + 1e-9
    clipped = current_of(recorded(ClippedCurrent(share=0.6)))
    assert np.max(np.abs(clipped)) == pytest.approx(1.2)


def test_hum_coloured_noise_and_spikes() -> None:
    hum = recorded(Hum(speed=2.0, current=0.0), noise=NOISE)
    spectrum = np.abs(np.fft.rfft(hum.speed - true_speed(hum.time)))
    assert np.argmax(spectrum) == 50.0 * TICKS / RATE
    coloured = recorded(ColouredNoise(speed=10.0, current=0.0, samples=20.0), noise=NOISE)
    left = coloured.speed - true_speed(coloured.time)
    assert np.std(left) == pytest.approx(1.0, rel=0.4)
    assert np.corrcoef(left[:-1], left[1:])[0, 1] > 0.9
    spiky = recorded(Spikes(share=0.01))
    off = np.abs(spiky.speed - true_speed(spiky.time)) > 1e-6
    assert 0 < np.count_nonzero(off) < 0.03 * TICKS
    assert np.max(np.abs(spiky.speed)) == pytest.approx(75.0)


def test_measured_voltage_is_noisy() -> None:
    noisy = recorded(NoisyVoltage(noise=0.01))
    assert np.std(noisy.voltage - np.arange(TICKS)) == pytest.approx(0.01 * TICKS, rel=0.1)


@pytest.mark.parametrize("jitter", [Jitter(reach=0.3, lost=0.01), ResampledJitter(reach=0.3, lost=0.01)])
def test_jitter_is_stamped_rightly(jitter: Imperfection) -> None:
    seen = recorded(jitter)
    assert 0.97 * TICKS < seen.time.size < TICKS
    assert np.all(np.diff(seen.time) > 0.0)
    assert np.ptp(np.diff(seen.time)) > 0.3 / RATE
    np.testing.assert_allclose(seen.speed, true_speed(seen.time), atol=0.01)
    np.testing.assert_array_equal(seen.voltage, np.floor(seen.time * RATE + 1e-6))


def test_late_channels() -> None:
    late = recorded(LateChannel(signal="current", samples=1.5))
    np.testing.assert_allclose(current_of(late)[10:], true_current(late.time[10:] - 1.5e-3), atol=1e-4)
    np.testing.assert_allclose(late.speed, true_speed(late.time), atol=1e-9)
    moved = recorded(LateChannel(signal="speed", samples=1.5))
    np.testing.assert_allclose(moved.speed[10:], true_speed(moved.time[10:] - 1.5e-3), atol=1e-2)


def test_rows_are_lost_thinned_and_cut_off() -> None:
    lost = recorded(LostRows(share=0.02))
    assert 0.96 * TICKS < lost.time.size < TICKS
    np.testing.assert_allclose(lost.speed, true_speed(lost.time), atol=1e-9)
    thin = recorded(Thinned(every=3))
    np.testing.assert_allclose(np.diff(thin.time), 3.0 / RATE)
    np.testing.assert_array_equal(np.diff(thin.voltage), 3.0)
    moving = recorded(StartsInMotion(share=0.15))
    assert moving.time[0] == 0.0
    np.testing.assert_allclose(moving.speed, true_speed(moving.time + 0.3), atol=1e-9)


def test_stamps() -> None:
    rounded = recorded(Jitter(reach=0.2, lost=0.0), RoundedTime(step=1e-4))
    np.testing.assert_allclose(rounded.time * 1e4, np.round(rounded.time * 1e4), atol=1e-6)
    fast = recorded(FastClock(share=0.001))
    np.testing.assert_allclose(fast.time, 1.001 * np.arange(TICKS) / RATE)


def test_power_stage_and_friction_differ_by_recording() -> None:
    enabled = LateEnable(durations=(0.0, 0.2, 0.0))
    assert [enabled.off(k) for k in range(3)] == [0.0, 0.2, 0.0]
    uneven = UnevenFriction(factors=(1.0, 1.1))
    plant = {"resistance": 1.0, "viscous_friction": 2.0, "coulomb_plus": 3.0, "coulomb_minus": 4.0}
    assert uneven.machine(0, plant) == plant
    assert uneven.machine(1, plant) == pytest.approx(
        {"resistance": 1.0, "viscous_friction": 2.2, "coulomb_plus": 3.3, "coulomb_minus": 4.4}
    )


def _drawn(name: str) -> Imperfection:
    slow = {"rounded-time": {"rate": 1500.0}}
    instruments = Instruments(**(vars(INSTRUMENTS) | slow.get(name, {})))
    return KINDS[name].draw(np.random.default_rng(3), instruments)


@pytest.mark.parametrize("name", KINDS)
def test_what_is_drawn_has_sizes_and_leaves_the_noiseless_rows_in_place(name: str) -> None:
    one = _drawn(name)
    assert one.kind == name
    assert one.sizes()
    dirty, clean = recorded(one, noise=NOISE), recorded(one, noise=NOISE, clean=True)
    np.testing.assert_array_equal(dirty.time, clean.time)
    again = recorded(one, noise=NOISE)
    np.testing.assert_array_equal(dirty.speed, again.speed)


def test_one_imperfection_less_changes_nothing_about_the_others() -> None:
    spikes = Spikes(share=0.01)
    both, alone = recorded(GainError(speed=0.0, current=0.0, stated=0.01), spikes), recorded(spikes)
    np.testing.assert_array_equal(both.speed, alone.speed)


def test_one_to_three_that_go_together_are_drawn() -> None:
    numbers: dict[int, int] = {}
    kinds: set[str] = set()
    for seed in range(300):
        unlike: Any = ("speed-sensor-lag",) if seed % 2 else ()
        chain = draw(np.random.default_rng(seed), INSTRUMENTS, unlike=unlike)
        numbers[len(chain)] = numbers.get(len(chain), 0) + 1
        names = [each.kind for each in chain]
        kinds |= set(names)
        assert not any(exclude(a, b) for a in names for b in names)
        assert not any(each.like & set(unlike) for each in chain)
        assert names == [name for name in KINDS if name in names]
    assert set(numbers) == {1, 2, 3}
    assert len(KINDS) >= 10
    assert kinds >= set(KINDS) - {"rounded-time"}
