#include "rwn/networks/rates/fixed.hpp"

#include <stdexcept>
#include <string>

namespace rwn {
namespace {

template <std::size_t N>
std::array<double, N> masked(const std::vector<double>& values, const std::array<bool, N>& learn) {
  if (values.size() != N) {
    throw std::invalid_argument("fixed rates: expected " + std::to_string(N) + " values, one per group, got " +
                                std::to_string(values.size()));
  }
  std::array<double, N> out{};
  for (std::size_t g = 0; g < N; ++g) {
    out[g] = learn[g] ? values[g] : 0.0;
  }
  return out;
}

struct FixedStructured : StructuredRates {
  StructuredRateValues values;
  explicit FixedStructured(StructuredRateValues v) : values(v) {}
  double train(StructuredRun& run, const StructuredSignals& signals) override {
    return run.train(signals, values.data());
  }
  StructuredRateValues rates() const override { return values; }
};

struct FixedRecurrent : RecurrentRates {
  RecurrentRateValues values;
  explicit FixedRecurrent(RecurrentRateValues v) : values(v) {}
  double train(RecurrentRun& run, const RecurrentSignals& signals) override {
    return run.train(signals, values.data());
  }
  RecurrentRateValues rates() const override { return values; }
};

}  // namespace

std::unique_ptr<StructuredRates> FixedRates::on(const StructuredNetwork&, const StructuredMask& learn) const {
  return std::make_unique<FixedStructured>(masked(values, learn));
}

std::unique_ptr<RecurrentRates> FixedRates::on(const RecurrentNetwork&, const RecurrentMask& learn) const {
  return std::make_unique<FixedRecurrent>(masked(values, learn));
}

}  // namespace rwn
