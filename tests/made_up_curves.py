"""Curves of made-up diagnoses."""

from __future__ import annotations

import numpy as np

from rwn.report.plot import Mark, Plot, Role, Slot, Trace


def over_time(rng: np.random.Generator) -> tuple[Plot, ...]:
    """A recording that was kept back: response, error and input."""
    t = np.arange(0.0, 20.0, 0.01)
    true = 180 * np.sin(1.9 * t) * np.exp(-t / 40)
    measured = true + rng.normal(0, 0.8, t.size)
    nominal = true + 14 * np.sign(np.cos(1.9 * t))
    refitted = true + 6 * np.sign(np.cos(1.9 * t))
    corrected = true + 0.4 * np.sin(7 * t)

    def panel(slot: Slot, label: str, unit: str, lines: dict[str, tuple[Role, np.ndarray]]) -> Plot:
        traces = tuple(Trace(name=name, role=role, x=t, y=y) for name, (role, y) in lines.items())
        return Plot(
            slot=slot, title=f"{label}, heldout_1.csv", x_label="time", x_unit="s", y_label=label, y_unit=unit,
            traces=traces, recording="heldout_1.csv", use="heldout", zoom=(4.0, 5.5),
        )  # fmt: skip

    return (
        panel("response", "speed", "rad/s", {
            "measured": ("measured", measured), "nominal as given": ("nominal", nominal),
            "nominal refitted": ("refitted", refitted), "corrected": ("corrected", corrected),
        }),
        panel("residual-time", "speed error", "rad/s", {
            "nominal refitted": ("before", measured - refitted), "corrected": ("after", measured - corrected),
        }),
        panel("input", "voltage", "V", {"input": ("reference", 24 * np.sign(np.sin(1.9 * t)))}),
    )  # fmt: skip


def over_speed(rng: np.random.Generator) -> Plot:
    """What the refitted model leaves, over speed."""
    t = np.arange(0.0, 20.0, 0.02)
    speed = 180 * np.sin(1.9 * t)
    before = 0.021 * np.tanh(speed / 3) + rng.normal(0, 0.003, t.size)
    return Plot(
        slot="residual-speed",
        title="Unknown torque over speed",
        x_label="speed",
        x_unit="rad/s",
        y_label="unknown torque",
        y_unit="N m",
        traces=(
            Trace(name="train_1.csv", role="before", x=speed, y=before, points=True, at=t, recording="heldout_1.csv"),
        ),
        marks=(Mark(low=-12.0, high=12.0, label="reversals"),),
        shown=(-0.04, 0.04),
    )


def law() -> Plot:
    """The torque that was found, beside the learned one."""
    w = np.linspace(-180, 180, 721)
    torque = 0.021 * np.sign(w)
    traces = (
        Trace(name="learned from the residual", role="reference", x=w, y=0.021 * np.tanh(w / 4)),
        Trace(name="Coulomb friction", role="corrected", x=w, y=torque, low=torque - 0.001, high=torque + 0.001),
    )
    return Plot(
        slot="law",
        title="Torque against speed",
        x_label="speed",
        x_unit="rad/s",
        y_label="torque",
        y_unit="N m",
        traces=traces,
    )


def spectrum(rng: np.random.Generator) -> Plot:
    """Periods per revolution, one of them strong."""
    order = np.linspace(0, 40, 400)
    floor = 1e-4 * (1 + 0.3 * rng.random(400))
    peak = floor + 3e-3 * np.exp(-(((order - 14) / 0.12) ** 2))
    traces = (
        Trace(name="before", role="before", x=order, y=peak),
        Trace(name="after", role="after", x=order, y=floor),
        Trace(name="chance, 95 %", role="noise-floor", x=order, y=np.full(400, 1.6e-4)),
    )
    return Plot(
        slot="spectrum",
        title="Unexplained torque over the angle",
        x_label="Periods per revolution",
        x_unit="",
        y_label="Amplitude",
        y_unit="N m",
        traces=traces,
        marks=(Mark(low=13.5, high=14.5, label="14"),),
    )
