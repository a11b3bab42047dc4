#include "rwn/networks/initialisation/heuristic.hpp"

namespace rwn {

Shapes heuristic(const RowMatrixRef& x, int wavelets) {
  const Domain domain(x);
  return {(0.5 * (domain.low + domain.high)).replicate(wavelets, 1),
          (0.2 * (domain.high - domain.low)).replicate(wavelets, 1)};
}

}  // namespace rwn
