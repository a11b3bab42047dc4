// What simulations have cost, counted rather than timed, so that it is the same on every machine.
#pragma once

#include <atomic>

namespace rwn {

/// Adds up over simulations, which may run at the same time. One unit is about a nanosecond of a 4 GHz core.
class Work {
 public:
  void add(long units) { done_.fetch_add(units, std::memory_order_relaxed); }
  long done() const { return done_.load(std::memory_order_relaxed); }

 private:
  std::atomic<long> done_{0};
};

}  // namespace rwn
