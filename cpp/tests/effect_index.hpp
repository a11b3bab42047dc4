// Effects by their names, for tests.
#pragma once

#include <string_view>
#include <tuple>

#include "rwn/model/effects.hpp"

namespace rwn {

/// The place of an effect in the table; -1 where there is none of this name.
inline int effect_index(std::string_view name) {
  int found = -1, k = 0;
  std::apply([&](auto... e) { ((decltype(e)::info.name == name ? void(found = k) : void(), ++k), ...); }, Effects{});
  return found;
}

}  // namespace rwn
