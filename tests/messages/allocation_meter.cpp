#include "tests/messages/allocation_meter.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// It is atomic because a runtime's own threads may allocate; the meter itself is for one thread.
std::atomic<std::ptrdiff_t> held{0}, peak_held{0}, held_at_start{0};
std::atomic<std::size_t> largest_single{0};

}  // namespace

// The nothrow forms are replaced as well: under ASan the standard ones do not call those that are replaced here.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* block = std::malloc(size == 0 ? 1 : size);
  if (block == nullptr) return nullptr;
  held += static_cast<std::ptrdiff_t>(malloc_usable_size(block));
  peak_held = std::max(peak_held.load(), held.load());
  largest_single = std::max(largest_single.load(), size);
  return block;
}

void* operator new(std::size_t size) {
  void* block = operator new(size, std::nothrow);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void operator delete(void* block) noexcept {
  if (block != nullptr) held -= static_cast<std::ptrdiff_t>(malloc_usable_size(block));
  std::free(block);
}

void operator delete(void* block, std::size_t) noexcept { operator delete(block); }

void operator delete(void* block, const std::nothrow_t&) noexcept { operator delete(block); }

namespace tern {

AllocationMeter::AllocationMeter() {
  held_at_start = held.load();
  peak_held = held.load();
  largest_single = 0;
}

std::size_t AllocationMeter::largest() const { return largest_single; }
std::size_t AllocationMeter::peak() const { return static_cast<std::size_t>(peak_held - held_at_start); }

}  // namespace tern
