// Where effects can attach to a kind of drive: the terms of motor.hpp that its equations have.
#pragma once

#include "rwn/model/drives.hpp"
#include "rwn/model/effects.hpp"
#include "rwn/model/own_effect.hpp"

namespace rwn {

inline constexpr Site all_sites[] = {Site::torque, Site::voltage, Site::flux, Site::actuator, Site::sensor, Site::load};

/// Whether the drive at this place of the table has the term that effects of this site change.
constexpr bool has_site(int drive, Site site) {
  return with_drive(drive, [site](auto d) {
    if (site == Site::actuator || site == Site::sensor) return true;
    if constexpr (decltype(d)::coefficients) {
      return false;
    } else {
      return !decltype(d)::forced || (site != Site::voltage && site != Site::flux);
    }
  });
}

/// The site of an effect by its place in the table.
constexpr Site site_of(int effect) {
  constexpr auto sites = std::apply([](auto... e) { return std::array{decltype(e)::info.site...}; }, Effects{});
  return sites[static_cast<std::size_t>(effect)];
}

/// The site of an own effect of this term.
constexpr Site site_of(Term term) {
  if (is_torque(term)) return Site::torque;
  if (is_sensor(term)) return Site::sensor;
  return term == Term::input ? Site::actuator : Site::voltage;
}

}  // namespace rwn
