#pragma once

#include <cstdint>
#include <cstring>

/// Eight float lanes by GCC vector extensions: one AVX register or two SSE registers, with the same
/// results either way (IEEE arithmetic lane by lane, no contraction, a fixed reduction order).
/// Kernels are marked POSEFUSION_KERNEL, which compiles them for AVX2 and for plain x86-64 and
/// chooses at run time; they work on plain float arrays so that no type's alignment depends on it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define POSEFUSION_KERNEL __attribute__((target_clones("avx2", "default")))
#else
#define POSEFUSION_KERNEL
#endif

#define POSEFUSION_INLINE inline __attribute__((always_inline))

namespace posefusion::simd {

constexpr int kLanes = 8;

using F8 = float __attribute__((vector_size(32)));
/// Integers, or truth values: -1 for true and 0 for false in every lane.
using I8 = std::int32_t __attribute__((vector_size(32)));

POSEFUSION_INLINE F8 Load(const float* p) {
  F8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

POSEFUSION_INLINE void Store(float* p, F8 v) { std::memcpy(p, &v, sizeof v); }

POSEFUSION_INLINE F8 Broadcast(float x) { return F8{x, x, x, x, x, x, x, x}; }

/// base, base + 1, ... in the lanes.
POSEFUSION_INLINE F8 Ramp(float base) {
  return F8{base, base + 1, base + 2, base + 3, base + 4, base + 5, base + 6, base + 7};
}

POSEFUSION_INLINE F8 Select(I8 condition, F8 yes, F8 no) { return condition ? yes : no; }
POSEFUSION_INLINE F8 Max(F8 a, F8 b) { return a > b ? a : b; }
POSEFUSION_INLINE F8 Min(F8 a, F8 b) { return a < b ? a : b; }
POSEFUSION_INLINE F8 Abs(F8 a) { return Max(a, -a); }
/// a where the condition holds, 0 elsewhere.
POSEFUSION_INLINE F8 ZeroUnless(I8 condition, F8 a) {
  return reinterpret_cast<F8>(reinterpret_cast<I8>(a) & condition);
}

/// Towards zero.
POSEFUSION_INLINE I8 ToInt(F8 a) { return __builtin_convertvector(a, I8); }

POSEFUSION_INLINE F8 Sqrt(F8 a) {
  F8 root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(a[i]);
  return root;
}

POSEFUSION_INLINE bool Any(I8 condition) {
  std::int32_t any = 0;
  for (int i = 0; i < kLanes; ++i) any |= condition[i];
  return any != 0;
}

/// Sum of the lanes in the order 0..7.
POSEFUSION_INLINE double Sum(F8 a) {
  double sum = 0;
  for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(a[i]);
  return sum;
}

}  // namespace posefusion::simd
