// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Arrays that vector loads like: 64-byte aligned, contiguous.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace ltc {

// The alignment of a cache line and of the widest vector register in use.
inline constexpr std::size_t vector_alignment = 64;

template <typename T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <typename U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(vector_alignment)));
  }
  void deallocate(T* pointer, std::size_t) {
    ::operator delete(pointer, std::align_val_t(vector_alignment));
  }
  bool operator==(const AlignedAllocator&) const { return true; }
};

template <typename T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
using AlignedFloats = AlignedVector<float>;

}  // namespace ltc
