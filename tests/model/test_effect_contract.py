"""What an effect has to be: the compiler refuses one that would do nothing, with a sentence that says what is wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from compiler import complaints

PARAMETER = 'Parameter{.name = "k", .symbol = "k", .unit = "N m s/rad", .meaning = "slope", .upper = 1.0, .start = 0.1}'
EFFECT = """
#include "rwn/model/effect.hpp"
using namespace rwn;
struct Drag {
  static constexpr EffectInfo info{"drag", Site::torque, "T = -k w", "meaning", "source"};
  static constexpr std::array parameters{PARAMETERS};
  static constexpr EffectTraits traits{TRAITS};
  template <class S>
  static RESULT HOOK(const S* p, const Motor<S>&, const Motion<S>& x, Terms<S>& t) { t.torque -= p[0] * x.speed; }
};
static_assert(Effect<Drag>);
"""
RIGHT = {"PARAMETERS": PARAMETER, "TRAITS": ".hooks = Hook::apply", "RESULT": "void", "HOOK": "apply"}


# A filter that remembers: with it the table has one effect more than rwn comes with.
REMEMBERS = """
#include "rwn/model/effects.hpp"
using namespace rwn;
struct Lag {
  static constexpr EffectInfo info{"lag", Site::sensor, "k dy/dt = w - y", "meaning", "source"};
  static constexpr std::array parameters{PARAMETERS};
  static constexpr EffectTraits traits{.hooks = Hook::begin | Hook::sense, .memories = MEMORIES};
  template <class S>
  static void begin(const S*, const Reading<S>& first, S* memory) { memory[0] = first.speed; }
  template <class S>
  static void sense(const S*, Reading<S>& y, const S* memory) { y.speed = memory[0]; }
};
using Table = decltype(std::tuple_cat(Effects{}, std::tuple<Lag>{}));
static_assert(detail::all_effects(static_cast<const Table*>(nullptr)));
"""


def said(place: Path, effect: str = EFFECT, **changed: str) -> str:
    """What the compiler says of an effect that differs from a right one; empty where it compiles."""
    return complaints(place, effect, RIGHT | changed)


def test_an_effect_compiles(tmp_path: Path) -> None:
    assert said(tmp_path) == ""


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        ({"HOOK": "aply"}, "hook `apply` is listed in traits and not there"),
        ({"TRAITS": ".hooks = Hook::rate"}, "hook `apply` is there and not listed in traits"),
        ({"RESULT": "int"}, "a hook of this effect has another signature"),
        ({"TRAITS": ".hooks = Hook::apply, .memories = 99"}, "an effect has at most max_memories"),
        (
            {"TRAITS": '.hooks = Hook::apply, .filters = "speed"', "PARAMETERS": ", ".join([PARAMETER] * 2)},
            "a filter of a sensor and a steady torque have one parameter",
        ),
        ({"PARAMETERS": ", ".join([PARAMETER] * 13)}, "an effect has one to max_effect_parameters parameters"),
        ({"PARAMETERS": PARAMETER.replace('"k"', '"q"')}, "a parameter of an effect has a `symbol`"),
    ],
    ids=["misspelt", "not listed", "signature", "memories", "two of a filter", "parameters", "symbol"],
)
def test_one_that_would_do_nothing_does_not(changed: dict[str, str], sentence: str, tmp_path: Path) -> None:
    assert sentence in said(tmp_path, **changed)


def test_there_is_room_for_effects_that_remember_more_than_those_of_today(tmp_path: Path) -> None:
    assert said(tmp_path, REMEMBERS, MEMORIES="4") == ""
    assert "no room for the memories of all effects" in said(tmp_path, REMEMBERS, MEMORIES="16")
