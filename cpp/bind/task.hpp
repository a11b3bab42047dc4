// What is simulated, as Python holds it: the arrays of one run and the equations that it obeys.
#pragma once

#include <vector>

#include "bind.hpp"
#include "rwn/simulate/simulate.hpp"

namespace rwn::bind {

/// The part of a SimulationTask that stays while its parameters are tried, and what its spans view.
struct Task {
  SimulationTask fixed;
  std::vector<Array> arrays;
  std::vector<OwnEffect> own;

  /// With parameters, the effects `active`, and derivatives by the parameters `by`; all of these outlive the call.
  SimulationTask with(const Array& parameters, const std::vector<int>& active, const std::vector<int>& by,
                      Work* work) const {
    SimulationTask task = fixed;
    task.own = own;
    task.parameters = view(parameters);
    task.active = active;
    task.by = by;
    task.work = work;
    return task;
  }
};

}  // namespace rwn::bind
