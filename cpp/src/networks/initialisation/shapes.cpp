#include "rwn/networks/initialisation/shapes.hpp"

#include <stdexcept>
#include <string>

namespace rwn {

Domain::Domain(const RowMatrixRef& x) : low(x.colwise().minCoeff()), high(x.colwise().maxCoeff()) {
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    if (!(high[i] > low[i])) {
      throw std::invalid_argument("input " + std::to_string(i) + " is constant (" + std::to_string(low[i]) +
                                  "): leave it out, a wavelet cannot be placed along it");
    }
  }
}

}  // namespace rwn
