#include "rwn/networks/wavelets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

namespace {

using rwn::Wavelet;

std::vector<Wavelet> all_wavelets() {
  std::vector<Wavelet> all;
  for (const std::string& name : rwn::wavelet_names()) {
    all.emplace_back(name, 5.0);
  }
  all.emplace_back("morlet", 1.75);
  return all;
}

class EveryWavelet : public ::testing::TestWithParam<Wavelet> {};

TEST_P(EveryWavelet, DerivativesAgreeWithTheComplexStep) {
  constexpr double h = 1e-30;
  GetParam().visit([](const auto& w) {
    for (double z = -6.0; z <= 6.0; z += 0.0371) {
      const std::complex<double> zh(z, h);
      EXPECT_NEAR(w.derivative(z), w.value(zh).imag() / h, 2e-15 * (1 + std::abs(w.derivative(0.3))));
      EXPECT_NEAR(w.second_derivative(z), w.derivative(zh).imag() / h, 1e-13);
    }
  });
}

TEST_P(EveryWavelet, BoundsAreTightAndNeverExceeded) {
  double value = 0.0;
  double derivative = 0.0;
  double scaled = 0.0;
  const Wavelet& w = GetParam();
  for (double z = 0.0; z < 10.0; z += 1e-4) {
    value = std::max(value, std::abs(w.value(z)));
    derivative = std::max(derivative, std::abs(w.derivative(z)));
    scaled = std::max(scaled, std::abs(z * w.derivative(z)));
  }
  const auto tight = [](double bound, double actual) { return bound >= actual && bound <= actual * (1.0 + 1e-6); };
  EXPECT_PRED2(tight, w.max_value(), value);
  EXPECT_PRED2(tight, w.max_derivative(), derivative);
  EXPECT_PRED2(tight, w.max_scaled_derivative(), scaled);
}

std::string name_of(const ::testing::TestParamInfo<Wavelet>& each) {
  std::string name = rwn::wavelet_names()[static_cast<std::size_t>(each.param.index())] + std::to_string(each.index);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Wavelets, EveryWavelet, ::testing::ValuesIn(all_wavelets()), name_of);

TEST(Wavelet, UnknownNameIsRefusedWithTheKnownOnes) {
  try {
    Wavelet("haar");
    FAIL();
  } catch (const std::invalid_argument& error) {
    for (const std::string& name : rwn::wavelet_names()) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
  }
}

TEST(Wavelet, Omega0MustBePositive) { EXPECT_THROW(Wavelet("morlet", 0.0), std::invalid_argument); }

}  // namespace
