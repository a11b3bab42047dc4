#include "allocations.hpp"

#include <atomic>
#include <cstddef>

namespace {
std::atomic<long> count{0};
}

#if defined(__SANITIZE_ADDRESS__)
// Of <sanitizer/allocator_interface.h>, which GCC does not install.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {
void count_one(const volatile void* /*where*/, std::size_t /*size*/) { count.fetch_add(1, std::memory_order_relaxed); }
void ignore(const volatile void* /*where*/) {}
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(count_one, ignore);
}  // namespace
#elif defined(__GLIBC__)
// operator new and Eigen both end here.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
}
#endif

long rwn::testing::allocations() { return count.load(); }
