#include "plant/wander.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace rwn {

namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double nodes_per_time = 32.0;

/// SplitMix64: the next number in (0, 1).
double uniform(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return (double((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

Wander::Wander(double rms, double time, double seed)
    : rms_(rms), spacing_(time / nodes_per_time), memory_(std::exp(-1.0 / nodes_per_time)),
      state_(static_cast<std::uint64_t>(std::abs(seed))) {
  if (rms != 0.0 && !(time > 0.0)) {
    throw std::invalid_argument("plant: the correlation time of a wandering torque must be positive");
  }
}

double Wander::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform(state_)));
  return radius * std::cos(two_pi * uniform(state_));
}

void Wander::extend(double time) {
  if (still()) return;
  const auto needed = static_cast<std::size_t>(time / spacing_) + 2;
  const double fresh = std::sqrt(1.0 - memory_ * memory_);
  if (nodes_.empty()) nodes_.push_back(normal());
  while (nodes_.size() < needed) nodes_.push_back(memory_ * nodes_.back() + fresh * normal());
}

double Wander::at(double time) const {
  const double place = time / spacing_;
  const auto node = static_cast<std::size_t>(place);
  const double part = place - double(node);
  return rms_ * ((1.0 - part) * nodes_[node] + part * nodes_[node + 1]);
}

}  // namespace rwn
