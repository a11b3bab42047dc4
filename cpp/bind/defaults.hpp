// The options of a trainer and what they are unless said otherwise: Python reads its defaults from here.
#pragma once

#include <utility>

#include "bind.hpp"

namespace rwn::bind {

template <class Trainer, class... Fields>
py::dict defaults_of(const std::pair<const char*, Fields>&... fields) {
  const Trainer trainer;
  py::dict values;
  ((values[fields.first] = trainer.*fields.second), ...);
  return values;
}

}  // namespace rwn::bind
