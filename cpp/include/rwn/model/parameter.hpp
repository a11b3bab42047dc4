// A parameter is described once, where it belongs; every other layer reads this description.
#pragma once

#include <array>
#include <string_view>

#include "rwn/model/scale.hpp"

namespace rwn {

struct Parameter {
  std::string_view name;
  std::string_view symbol{};  // in its equation; none where it is `idealised` and the equation does without
  std::string_view unit;
  std::string_view meaning;
  double lower = 0.0;  // in units of `scale`, as are upper, start and scan
  double upper = 0.0;
  double start = 0.0;  // first guess
  Scale scale{};
  std::array<double, 24> scan{};  // other first guesses worth trying; zeros at the end do not count
  bool strength = false;         // zero means that the effect is absent
  bool fixed = false;            // a constant of nature or convention, never fitted
  bool cyclic = false;           // an angle
  bool order = false;            // a spatial frequency, found from a spectrum over the angle
  bool idealised = false;        // a limit is an idealisation (abrupt, rigid) that is as good a law
  bool natural = false;          // a limit is one of nature (a share of 0 or 1), at which the law is itself
  int replaces = -1;             // the nominal motor parameter whose role this one takes over
  int line = 0;                  // of a periodic effect; lines above 0 act where their strength is not 0
  int beside = -1;               // the one that does the same: where that is fitted, this says nothing more
};

}  // namespace rwn
