#pragma once

#include <cmath>
#include <cstdint>

namespace posefusion {

/// Random numbers as a pure function of (seed, stream, index): any of them can be had at any time,
/// in any order and on any thread, and always comes out the same. The mixing is splitmix64
/// (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
class IndexedRandom {
 public:
  IndexedRandom(int seed, int stream)
      : key_(Mix(Mix(static_cast<std::uint64_t>(static_cast<std::int64_t>(seed))) ^
                 static_cast<std::uint64_t>(static_cast<std::int64_t>(stream)))) {}

  /// In [0, 1).
  double Uniform(std::int64_t index) const {
    constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
    return static_cast<double>(Mix(key_ ^ static_cast<std::uint64_t>(index)) >> 11) * kScale;
  }

  /// In [low, high).
  double Uniform(std::int64_t index, double low, double high) const {
    return low + (high - low) * Uniform(index);
  }

  /// Normally distributed with the given deviation (Box and Muller 1958).
  double Gaussian(std::int64_t index, double sigma) const {
    constexpr double kTwoPi = 6.283185307179586;
    const std::int64_t own = (2 * index) ^ (std::int64_t{1} << 62);  // apart from Uniform's
    const double u = 1 - Uniform(own);
    return sigma * std::sqrt(-2 * std::log(u)) * std::cos(kTwoPi * Uniform(own + 1));
  }

 private:
  static std::uint64_t Mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

  std::uint64_t key_;
};

}  // namespace posefusion
