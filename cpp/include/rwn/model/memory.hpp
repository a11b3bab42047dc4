// What effects remember from step to step.
#pragma once

#include "rwn/numerics/room.hpp"

namespace rwn {

inline constexpr int max_memories = 16;  // of all effects together: every one may act at once

/// Room for max_memories numbers, of which only those in use are copied with the state that they belong to.
template <class S>
class Memory {
 public:
  Memory() = default;
  Memory(const Memory& o) { *this = o; }
  Memory& operator=(const Memory& o) {
    used_ = o.used_;
    for (std::size_t k = 0; k < used_; ++k) numbers_[k] = o.numbers_[k];
    return *this;
  }

  /// Zeros for the first `count`.
  void use(int count) {
    used_ = static_cast<std::size_t>(count);
    for (std::size_t k = 0; k < used_; ++k) numbers_[k] = S(0.0);
  }

  S* data() { return numbers_.numbers; }
  const S* data() const { return numbers_.numbers; }

 private:
  Room<S, static_cast<std::size_t>(max_memories)> numbers_;
  std::size_t used_ = 0;
};

}  // namespace rwn
