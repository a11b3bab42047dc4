// Training of several structured networks at once, one per lane of a vector (thesis eq. 4.19, 4.29).
#pragma once

#include <vector>

#include "rwn/networks/online_training.hpp"

namespace rwn {

/// Several networks (seeds) on one recording, `width` of them side by side in the lanes of a vector, rates held.
struct SideBySide {
  RowMatrix theta;                   // (N, 5 + 4 N_w); of a diverged run before the cycle that diverged
  Vector mse_learning;               // (N) of the last cycle that did not diverge; infinite where the first did
  Vector mse_frozen;                 // (N) of theta
  std::vector<OnlineStatus> status;  // (N) as each run alone would have
};

/// rates is (N, groups). \throws std::invalid_argument for arrays that do not fit or cycles < 1.
SideBySide train_side_by_side(const Eigen::Ref<const RowMatrix>& theta, const Wavelet& wavelet,
                              const Eigen::Ref<const RowMatrix>& rates, const StructuredSignals& signals, int cycles);

}  // namespace rwn
