"""What a kind of drive has to be: the compiler refuses one that would be simulated wrongly, with a sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from compiler import complaints

DRIVE = """
#include "rwn/model/drives.hpp"
namespace rwn {
struct Spring {
  static constexpr std::string_view name = "NAME";
  static constexpr int states = STATES;
  static constexpr bool forced = FORCED;
  static constexpr bool coefficients = false;
  static constexpr int widths[] = {WIDTHS};
  template <class S>
  class Electrics {
   public:
    explicit Electrics(const Motor<S>&) {}
    static const Winding<S>& winding() { return no_winding<S>; }
    void begin(auto&) const {}
    static S current(const auto&) { return S(0.0); }
    S TORQUE(const auto&, const S&, const S& input) const { return input; }
  };
};
static_assert(DriveKind<Spring>);
}
"""
RIGHT = {"NAME": "spring", "STATES": "0", "FORCED": "true", "WIDTHS": "4, 8", "TORQUE": "torque"}


def said(place: Path, **changed: str) -> str:
    """What the compiler says of a drive that differs from a right one; empty where it compiles."""
    return complaints(place, DRIVE, RIGHT | changed)


def test_a_drive_compiles(tmp_path: Path) -> None:
    assert said(tmp_path) == ""


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        ({"NAME": ""}, "a drive has a `name`"),
        ({"WIDTHS": "8, 4"}, "are multiples of 4, ascending"),
        ({"WIDTHS": "3"}, "are multiples of 4, ascending"),
        ({"FORCED": "false"}, "a drive has electrical `states`, or its input is a torque (`forced`), and not both"),
        ({"STATES": "1"}, "a drive has electrical `states`, or its input is a torque (`forced`), and not both"),
        ({"TORQUE": "force"}, "`Electrics` of a drive has winding, begin, current and torque"),
        ({"STATES": "1", "FORCED": "false"}, "`Electrics` of a drive with states lacks a member"),
    ],
)
def test_what_a_drive_lacks_is_said(tmp_path: Path, changed: dict[str, str], sentence: str) -> None:
    assert sentence in said(tmp_path, **changed)
