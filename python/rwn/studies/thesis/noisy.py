"""What the experiments with noise share: noise of a stated ratio, the two-stage output-error fit, its judgement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

import rwn
from rwn.networks.arrays import Array
from rwn.networks.initialisation import StructuredSelection
from rwn.networks.trainers import StructuredFit, StructuredLevenbergMarquardt
from rwn.studies.thesis.drive import T
from rwn.studies.thesis.experiment import Row, median_row

RATIOS = (60.0, 50.0, 40.0, 30.0, 20.0, 10.0)  # signal to noise [dB]
FEWEST, MOST = 7, 31  # wavelets; the noise decides between them
WIDTH = 41  # samples of the smoothed speed
SEEN = 3.0  # narrowest wavelet, in units of the noise of the speed that it is selected along
SIZE = 0.1  # expected of every w [N m]
Feed = Literal["simulated", "smoothed", "measured"]


def noisy(x: Array, decibel: float, rng: np.random.Generator) -> tuple[Array, float]:
    """x with white noise at a signal-to-noise ratio of mean squares, and its deviation."""
    sigma = float(np.sqrt(np.mean(x**2)) * 10 ** (-decibel / 20))
    return x + sigma * rng.normal(size=len(x)), sigma


def smoothed(x: Array, width: int = WIDTH) -> Array:
    """Moving average, centred."""
    padded = np.pad(x, width // 2, mode="edge")
    return np.convolve(padded, np.full(width, 1 / width), mode="valid")


@dataclass(frozen=True, kw_only=True)
class Noisy:
    """One noisy recording; `noise` is the deviation on the speed, `noise_current` on the current if it is there."""

    voltage: Array
    speed: Array
    noise: float
    current: Array | None = None
    noise_current: float = 1.0

    @property
    def source(self) -> Array:
        """The smoothed speed."""
        return smoothed(self.speed)

    def fit(self, motor: rwn.MotorParameters, linear: tuple[str, ...], feed: Feed, steps: int) -> StructuredFit:
        """Levenberg-Marquardt from selected wavelets, as many as the noise lets one see.

        `simulated` first fits with the smoothed speed as the network's input, then with the speed that the model
        itself simulates, which no noise of the measurement reaches; m and d move in the last stage. A stage that gets
        stuck is not taken: its advice is to free fewer groups.
        """
        source = self.speed if feed == "measured" else self.source
        network = self.select(motor, linear, source)
        trainer = StructuredLevenbergMarquardt(iterations=steps, tolerance=1e-8, ridge=self.noise / SIZE)
        learn = (*linear, "w")
        best = self.step(trainer, network, learn, source, "measured")
        if feed == "simulated":
            for moving in (learn, (*learn, "m", "d")):
                further = replace(trainer, weights_first=False)
                step = self.step(further, best.network, moving, source, "simulated")
                if step.status == "stuck":  # a wavelet has become so steep that the motion is unstable in it
                    break
                best = step
        return best

    def step(
        self,
        trainer: StructuredLevenbergMarquardt,
        network: rwn.StructuredNetwork,
        learn: tuple[str, ...],
        source: Array,
        feed: Literal["measured", "simulated"],
    ) -> StructuredFit:
        """One fit of some groups."""
        return trainer.fit(
            network,
            self.voltage,
            self.speed,
            learn=learn,
            network_speed=source,
            feed=feed,
            current=self.current,
            current_weight=self.noise / self.noise_current,
        )

    def select(
        self, motor: rwn.MotorParameters, linear: tuple[str, ...], source: Array
    ) -> rwn.StructuredNetwork:
        """The motor with wavelets selected until the next would explain no more than noise; at least FEWEST.

        Wavelets narrower than SEEN times the noise of `source` are left out: it smears what they would show.
        """
        wrong = rwn.StructuredNetwork.from_motor(motor, sample_time=T)
        spread = self.noise if source is self.speed else self.noise / np.sqrt(WIDTH)
        every = StructuredSelection()
        scales = np.log2(every.zeta * np.ptp(source) / (SEEN * spread))
        seen = replace(every, levels=int(np.clip(1 + scales, 2, every.levels)))
        for way, most in ((replace(seen, noise=self.noise), MOST), (seen, FEWEST)):
            network = way.start(
                wrong, self.voltage, self.speed, wavelets=most, linear=linear, network_speed=source
            )
            if network.wavelets >= FEWEST:
                break
        return network


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """Relative errors by parameter [%], and their standard deviations [%] as the fit states them."""

    error: dict[str, float]
    deviation: dict[str, float]

    @property
    def covered(self) -> list[bool]:
        """Whether each 95 % interval holds the truth."""
        return [bool(abs(self.error[name]) <= 1.96 * self.deviation[name]) for name in self.deviation]


def rows_of(where: str, case: str, found: Sequence[Estimate], *, goal: float | None = None) -> list[Row]:
    """Median error of every parameter (with a `goal` its bias, the mean error, too), and the share of intervals
    that hold."""
    count = f"{len(found)} seeds"
    rows = []
    for name in found[0].error:
        values = [e.error[name] for e in found]
        sizes = [abs(v) for v in values]
        title = f"{case}: error of {name}"
        rows.append(median_row(where, title, None, sizes, judge="none", unit="%", count=count))
        if goal is not None:
            bias = abs(float(np.mean(values)))
            about = f"{case}: bias of {name}, to {1.96 * np.std(values) / np.sqrt(len(values)):.2g} %"
            rows.append(
                Row(where=where, case=about, ours=bias, judge="wanted", wanted=goal, unit="%", count=count)
            )
    intervals = [c for e in found for c in e.covered]
    share = float(np.mean(intervals))
    case = f"{case}: share of 95 % intervals that hold"
    return [*rows, Row(where=where, case=case, ours=share, judge="coverage", count=f"{len(intervals)} intervals")]
