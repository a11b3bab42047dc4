// What advances the state of each kind of drive.
#pragma once

#include "rwn/simulate/integrator.hpp"
#include "rwn/simulate/transfer_function.hpp"

namespace rwn {

/// A transfer function has no equations of motion.
template <class S, class Drive, int masses, bool = Drive::coefficients>
struct PlantOf {
  using type = Integrator<S, Drive, masses>;
};
template <class S, class Drive, int masses>
struct PlantOf<S, Drive, masses, true> {
  using type = TransferFunction<S>;
};

}  // namespace rwn
