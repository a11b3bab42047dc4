// Room for numbers that are written before they are read: nothing is put there beforehand, which for numbers with
// derivatives costs more than many a use of them.
#pragma once

#include <cstddef>

namespace rwn {

template <class S, std::size_t n>
union Room {
  Room() {}
  S& operator[](std::size_t k) { return numbers[k]; }
  const S& operator[](std::size_t k) const { return numbers[k]; }
  S numbers[n];
};

}  // namespace rwn
