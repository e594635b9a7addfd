#pragma once

#include <cstdint>
#include <vector>

namespace posefusion {

/// What the ferns say about an image: per fern four bits (red, green, blue and depth above their
/// thresholds), or kUnknownFern where a person stands or depth is missing.
using FernCode = std::vector<std::uint8_t>;

constexpr std::uint8_t kUnknownFern = 255;

/// How two codes compare.
struct FernComparison {
  int known = 0;  ///< ferns known in both
  int equal = 0;  ///< of these: with all four bits equal

  double Similarity() const { return known > 0 ? static_cast<double>(equal) / known : 0; }
};

/// Compares `num_ferns` ferns of each.
FernComparison CompareFerns(const std::uint8_t* a, const std::uint8_t* b, int num_ferns);

/// Share of the ferns that are known, 0..1.
double KnownShare(const FernCode& code);

}  // namespace posefusion
