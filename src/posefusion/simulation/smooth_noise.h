#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "posefusion/simulation/hash_random.h"

namespace posefusion {

/// About normal with mean 0 and standard deviation 1, from one hash: the sum of its four bytes
/// (Irwin-Hall), within +-3.45.
inline float GaussianFloat(std::uint32_t hash) {
  const std::uint32_t pairs = (hash & 0x00ff00ffU) + ((hash >> 8) & 0x00ff00ffU);
  const auto sum = static_cast<float>((pairs & 0xffffU) + (pairs >> 16));
  return (sum - 510.0F) * (1.0F / 147.8F);
}

/// Random numbers over an image that agree within a few pixels, as everything that a depth camera
/// finds by comparing windows does: mean 0, standard deviation 1 everywhere.
class SmoothNoise {
 public:
  SmoothNoise(std::uint32_t key, int spacing_px) : key_(key), spacing_(spacing_px) {}

  float At(int x, int y) const {
    const int column = x / spacing_;
    const int row = y / spacing_;
    const float s = Share(x - column * spacing_);
    const float t = Share(y - row * spacing_);
    return Mixed({Node(column, row), Node(column, row + 1)},
                 {Node(column + 1, row), Node(column + 1, row + 1)}, s, t);
  }

  /// At(0, y), At(1, y), ... for the first `values.size()` columns, in less time.
  void FillRow(int y, std::vector<float>& values) const {
    const int row = y / spacing_;
    const float t = Share(y - row * spacing_);
    Pair left;
    Pair right{Node(0, row), Node(0, row + 1)};
    int offset = spacing_;
    int column = 0;
    for (float& value : values) {
      if (offset == spacing_) {
        left = right;
        ++column;
        right = {Node(column, row), Node(column, row + 1)};
        offset = 0;
      }
      value = Mixed(left, right, Share(offset++), t);
    }
  }

 private:
  /// Neighbouring nodes of a column.
  struct Pair {
    float top = 0;
    float bottom = 0;
  };

  static float Mixed(const Pair& left, const Pair& right, float s, float t) {
    const float top = left.top * (1 - s) + right.top * s;
    const float bottom = left.bottom * (1 - s) + right.bottom * s;
    const float weight = (s * s + (1 - s) * (1 - s)) * (t * t + (1 - t) * (1 - t));
    return (top * (1 - t) + bottom * t) / std::sqrt(weight);
  }
  float Share(int offset) const {
    return (static_cast<float>(offset) + 0.5F) / static_cast<float>(spacing_);
  }
  float Node(int column, int row) const {
    const auto number =
        static_cast<std::uint32_t>(row) * 65536U + static_cast<std::uint32_t>(column);
    return GaussianFloat(Mix(key_ ^ Mix(number)));
  }

  std::uint32_t key_;
  int spacing_;
};

}  // namespace posefusion
