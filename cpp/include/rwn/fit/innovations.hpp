// What is new in the errors of a simulation whose noise is an autoregression: what those before do not predict.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rwn {

/// Replaces `errors` (n) by their innovations, and `slopes` (n, p) of their simulation by the slopes that go with them.
///
/// `reflection`: partial autocorrelations of the noise, each below 1 in size (Durbin 1960). The first errors have fewer
/// before them; they are predicted by as many, and scaled to the variance of the others. Errors that are NaN are passed
/// over: those on both sides count as neighbours. Every `restart` samples the motion starts anew, and so do the errors;
/// 0: never.
void innovations(std::span<double> errors, const std::vector<double>& reflection, std::size_t restart = 0,
                 std::span<double> slopes = {});

}  // namespace rwn
