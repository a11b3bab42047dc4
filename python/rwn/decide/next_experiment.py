"""Explanations that signals cannot separate, and the experiment that would (field knowledge, one row a pair)."""

from __future__ import annotations

from collections.abc import Sequence

_SEPARATED_BY: tuple[tuple[frozenset[str], str], ...] = (
    (frozenset({"asymmetric-friction", "constant-load"}), "breakaway from rest in both directions, or the shaft turned by hand with torque off"),
    (frozenset({"viscous-friction", "brush-voltage-drop"}), "a recording of the current, or a coast-down with open terminals"),
    (frozenset({"brush-voltage-drop", "coulomb-friction"}), "a recording of the current, or a run in the braking quadrant"),
    (frozenset({"brush-voltage-drop", "actuator-deadzone"}), "the terminal voltage measured with its own voltmeter while the current reverses at speed"),
    (frozenset({"coulomb-friction", "actuator-deadzone"}), "a recording of the current, or a stall test with small commands"),
    (frozenset({"resistance-heating", "load-disturbance"}), "the same run warm and cold, with current and two speeds"),
    (frozenset({"resistance-heating", "magnetic-saturation"}), "a short and a long run at the same high current"),
    (frozenset({"input-delay", "speed-sensor-lag"}), "a command with energy above 1/(2 pi tau): the phase of a lag settles, that of a delay does not"),
    (frozenset({"backlash", "shaft-compliance"}), "reversals at two amplitudes, or an encoder on the load"),
    (frozenset({"backlash", "presliding-hysteresis"}), "reversals at two amplitudes and two rates"),
    (frozenset({"shaft-compliance", "presliding-hysteresis"}), "reversals at two rates"),
    (frozenset({"cogging-torque", "torque-ripple"}), "two current levels at one position: cogging does not change with current"),
    (frozenset({"magnetic-saturation", "quadratic-drag"}), "high current at low speed (blocked shaft)"),
    (frozenset({"stribeck-friction", "presliding-hysteresis"}), "slow ramps through standstill with a finer speed signal"),
    (frozenset({"stribeck-friction", "coulomb-friction"}), "slow ramps through standstill with a finer speed signal"),
    (frozenset({"coulomb-friction", "load-dependent-friction"}), "two known loads at the same speed"),
    (frozenset({"sensor-bias", "constant-load"}), "a recording at standstill with no voltage"),
    (frozenset({"sensor-bias", "asymmetric-friction"}), "a recording at standstill with no voltage"),
    (frozenset({"wrong-unit", "wrong-gear-ratio"}), "the shaft turned by hand ten turns, and what the sensor shows of them"),
    (frozenset({"unbalance", "position-dependent-friction"}), "slow turns in both directions: a friction changes sign, an unbalance does not"),
)  # fmt: skip


def separated_by(names: Sequence[str]) -> str:
    """The experiment that tells these explanations apart; empty where none is on record."""
    found = [text for pair, text in _SEPARATED_BY if pair <= set(names)]
    return "; ".join(dict.fromkeys(found))
