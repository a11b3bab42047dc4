// Arrays of doubles that start on a cache line and are padded to the widest vector, for the kernels.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace rwn {

inline constexpr int lanes = 8;  // doubles in the widest vector of any instruction set

/// n rounded up to whole vectors.
constexpr int padded(int n) { return (n + lanes - 1) / lanes * lanes; }

template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

using AlignedVector = std::vector<double, AlignedAllocator<double>>;

}  // namespace rwn
