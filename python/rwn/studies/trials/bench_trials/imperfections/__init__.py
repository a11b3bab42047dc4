"""What loggers do to recordings. A new kind is a file and its place in the chain here."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from rwn.studies.trials.bench_trials.imperfections import (
    coloured_noise,
    converter,
    drive_filter,
    encoder_difference,
    gain_error,
    held,
    hum,
    jitter,
    late_channel,
    late_enable,
    lost_rows,
    noisy_voltage,
    spikes,
    stamps,
    starts_in_motion,
    thinned,
    uneven_friction,
    zero_offset,
)
from rwn.studies.trials.bench_trials.imperfections.encoder_difference import EncoderDifference as EncoderDifference
from rwn.studies.trials.bench_trials.imperfections.imperfection import Imperfection as Imperfection
from rwn.studies.trials.bench_trials.imperfections.imperfection import Instruments as Instruments
from rwn.studies.trials.bench_trials.imperfections.imperfection import Kind, Rng

# In the order of the chain: machine, power stage, wiring, electronics, drive, bus, file, timestamps.
KINDS: dict[str, Kind] = {
    kind.name: kind
    for kind in (
        uneven_friction.KIND,
        late_enable.KIND,
        late_channel.KIND,
        jitter.KIND,
        gain_error.KIND,
        zero_offset.KIND,
        hum.KIND,
        coloured_noise.KIND,
        noisy_voltage.KIND,
        converter.CLIPPED,
        converter.KIND,
        encoder_difference.KIND,
        drive_filter.KIND,
        held.KIND,
        jitter.RESAMPLED,
        spikes.KIND,
        thinned.KIND,
        lost_rows.KIND,
        starts_in_motion.KIND,
        stamps.FAST,
        stamps.KIND,
    )
}

EXCLUDING: dict[frozenset[str], str] = {
    frozenset(pair): why
    for pair, why in {
        ("jitter", "resampled-jitter"): "one logger has one clock",
        ("jitter", "lost-rows"): "it loses rows already",
        ("resampled-jitter", "lost-rows"): "it loses rows already",
        ("jitter", "drive-filter"): "a drive filters on its own clock, which a logger beside it does not know",
        ("jitter", "encoder-difference"): "a drive differences on its own clock",
        ("jitter", "values-held"): "a bus that holds values has them from a clock",
        ("encoder-difference", "drive-filter"): "the smoothing of the difference is the drive's filter",
        ("encoder-difference", "hum"): "counts do not hum",
        ("encoder-difference", "coloured-noise"): "counts have no noise but their rounding",
        ("encoder-difference", "gain-error"): "counts are exact",
        ("encoder-difference", "zero-offset"): "counts have no zero",
        ("values-held", "thinned"): "held rows that are thinned out are rows of a slower bus, or thinned ones",
        ("values-held", "resampled-jitter"): "lines between held values are not what a bus or a logger writes",
        ("jitter", "rounded-time"): "rounded, two instants may be the same, and no reader takes that",
        ("resampled-jitter", "rounded-time"): "rounded, two instants may be the same, and no reader takes that",
        ("late-enable", "starts-in-motion"): "what is cut off is the part before the power stage was on",
    }.items()
}
SHARES = (0.4, 0.4, 0.2)  # of the trials with one, two and three


def exclude(a: str, b: str) -> str:
    """Why two kinds cannot be in one trial; empty where they can."""
    return EXCLUDING.get(frozenset((a, b)), "")


def draw(rng: Rng, instruments: Instruments, *, unlike: Collection[str]) -> tuple[Imperfection, ...]:
    """One to three that go together, in the order of the chain.

    None of them is what an effect of the names `unlike` is called too: the answer would be true and false at once.
    """
    wanted = 1 + int(rng.choice(len(SHARES), p=SHARES))
    chosen: list[Imperfection] = []
    for name in rng.permutation(list(KINDS)):
        if len(chosen) < wanted and KINDS[name].suits(instruments) and _fits(name, chosen):
            drawn = KINDS[name].draw(rng, instruments)
            chosen += [] if drawn.like & set(unlike) else [drawn]
    order = list(KINDS)
    return tuple(sorted(chosen, key=lambda each: order.index(each.kind)))


def _fits(name: str, chosen: Sequence[Imperfection]) -> bool:
    return not any(exclude(name, each.kind) for each in chosen)
