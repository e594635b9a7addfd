#include "posefusion/loop_closure/fern_code.h"

#include <algorithm>

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

POSEFUSION_KERNEL void Count(const std::uint8_t* a, const std::uint8_t* b, int size,
                             FernComparison& counts) {
  int known = 0;
  int equal = 0;
  for (int i = 0; i < size; ++i) {
    const int both =
        static_cast<int>(a[i] != kUnknownFern) & static_cast<int>(b[i] != kUnknownFern);
    known += both;
    equal += both & static_cast<int>(a[i] == b[i]);
  }
  counts.known = known;
  counts.equal = equal;
}

}  // namespace

FernComparison CompareFerns(const std::uint8_t* a, const std::uint8_t* b, int num_ferns) {
  FernComparison counts;
  Count(a, b, num_ferns, counts);
  return counts;
}

double KnownShare(const FernCode& code) {
  if (code.empty()) return 0;
  const auto unknown = std::count(code.begin(), code.end(), kUnknownFern);
  return 1 - static_cast<double>(unknown) / static_cast<double>(code.size());
}

}  // namespace posefusion
