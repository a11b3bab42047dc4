// Per-sample training of the recurrent and the structured network (thesis eq. 3.19, 4.19, 4.29): what a run returns.
#pragma once

#include <string_view>
#include <vector>

#include "rwn/networks/rates/rule.hpp"

namespace rwn {

enum class OnlineStatus { completed, stalled, unstable, diverged };

std::string_view to_string(OnlineStatus status);
/// What happened and what to try, in one sentence.
std::string_view advice(OnlineStatus status);

struct OnlineOptions {
  int cycles = 1;
  int frozen_every = 0;  // cycles between evaluations with frozen parameters; 0: before the first and after the last
  bool follow_state = false;  // after each correction x += (dx/dtheta) dtheta (structured network only)
};

/// Histories of a run. The error while learning is a tracking error; only the frozen one tells how good the network is.
struct OnlineHistory {
  OnlineStatus status = OnlineStatus::completed;
  std::vector<double> mse_learning;            // one per cycle
  std::vector<double> mse_frozen;              // one per entry of frozen_after
  std::vector<int> frozen_after;               // number of cycles trained before that evaluation
  std::vector<std::vector<double>> parameters;  // of the linear groups (structured) at the end of each cycle
  std::vector<std::vector<double>> rates;       // of every group at the end of each cycle
  std::vector<double> bounds;                   // of ||dy/dtheta_g|| behind the last rates, 0 where the rule has none
  RateReport report;
};

/// Largest MSE of a run that has not diverged.
double divergence_limit(double mean_square, double first_mse);

/// Status of a run that reached its end: `still` where its last cycle moved no parameter.
OnlineStatus judge(const StructuredNetwork& network, bool still, double mse_frozen, double mean_square);
/// True where no parameter moved by more than rounding.
bool stands_still(const VectorRef& before, const VectorRef& after);

/// Decides after each cycle whether to go on; keeps the histories. Called once per cycle, not per sample.
class OnlineWatch {
 public:
  OnlineWatch(OnlineHistory& history, double mean_square, double first_mse);
  /// True when the run must stop: the error or a parameter is not finite, or grew beyond 1e6 times what it began with.
  bool diverged(double mse, const Vector& theta);

 private:
  OnlineHistory& history_;
  double limit_;
};

struct StructuredTraining {
  StructuredNetwork network;  // the last one; of a diverged run the one before the cycle that diverged
  OnlineHistory history;
};

/// A cycle that leaves the parameters and the rule as they were, bit for bit, is repeated by all that follow: they are
/// in the history and are not run. `rules.hpp` makes the rates.
/// \throws std::invalid_argument for signals of different lengths or cycles < 1.
StructuredTraining train(const StructuredNetwork& network, const StructuredSignals& signals, StructuredRates& rates,
                         const StructuredMask& learn, const OnlineOptions& options);

struct RecurrentTraining {
  RecurrentNetwork network;
  OnlineHistory history;
};
RecurrentTraining train(const RecurrentNetwork& network, const RecurrentSignals& signals, RecurrentRates& rates,
                        const OnlineOptions& options);

}  // namespace rwn
