// The table of the kinds of drive. A new one is a file in drives/, its include and its entry in the tuple; its
// counterpart in Python is a file in python/rwn/model/drives/.
//
// What a drive says of itself is in drive.hpp. The integrator, the effects and the second mass know no more.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "rwn/model/drive.hpp"
#include "rwn/model/drives/axis.hpp"
#include "rwn/model/drives/dc.hpp"
#include "rwn/model/drives/lti.hpp"

namespace rwn {

using Drives = std::tuple<DcDrive, AxisDrive, LtiDrive>;

static_assert(std::apply([](auto... d) { return (DriveKind<decltype(d)> && ...); }, Drives{}));

inline constexpr int drive_count = static_cast<int>(std::tuple_size_v<Drives>);

/// Names in the order of the table.
inline constexpr std::array<std::string_view, drive_count> drive_names =
    std::apply([](auto... d) { return std::array<std::string_view, drive_count>{decltype(d)::name...}; }, Drives{});

/// What `of` says of the drive at a place of the table; `of` takes a drive.
template <int place = 0, class F>
constexpr auto with_drive(int drive, const F& of) {
  if constexpr (place + 1 < drive_count) {
    if (drive != place) return with_drive<place + 1>(drive, of);
  }
  return of(std::tuple_element_t<place, Drives>{});
}

/// The least of a drive's widths that holds `columns` derivatives, or the largest; 0 where there are none.
template <class Drive>
constexpr int width_for(int columns) {
  int best = 0;
  for (int width : Drive::widths) {
    if (columns > best) best = width;
  }
  return columns > 0 ? best : 0;
}

}  // namespace rwn
