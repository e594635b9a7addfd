#pragma once

#include <cmath>
#include <cstdint>

namespace posefusion {

/// Random numbers without state: the same key gives the same number in any order of calls, which
/// is what makes images independent of threads.

/// A well-mixed number of a key. Mixer: Ettinger, "Hash prospector", 32-bit, bias 0.17.
inline std::uint32_t Mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

inline std::uint32_t HashOf(std::uint32_t a, std::uint32_t b, std::uint32_t c = 0,
                            std::uint32_t d = 0) {
  return Mix(d + Mix(c + Mix(b + Mix(a + 0x9e3779b9U))));
}

/// [0, 1) with 24 bits.
inline float UnitFloat(std::uint32_t hash) { return static_cast<float>(hash >> 8) * 0x1p-24F; }

/// Consecutive numbers of one key; for things made one after the other.
class HashSequence {
 public:
  explicit HashSequence(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0)
      : key_(HashOf(a, b, c)) {}

  std::uint32_t Next() { return HashOf(key_, count_++); }
  float Uniform(float from = 0, float to = 1) { return from + (to - from) * UnitFloat(Next()); }
  /// A whole number in [0, count).
  int Below(int count) { return static_cast<int>(Uniform() * static_cast<float>(count)); }

 private:
  std::uint32_t key_;
  std::uint32_t count_ = 0;
};

}  // namespace posefusion
