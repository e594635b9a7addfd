#include "posefusion/evaluation/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace posefusion {
namespace {

constexpr double kHighShare = 0.95;

}  // namespace

ErrorStatistics Summarize(const std::vector<double>& errors) {
  ErrorStatistics result;
  if (errors.empty()) return result;
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t size = sorted.size();
  const auto count = static_cast<double>(size);
  const double square_sum = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
  result.count = static_cast<int>(size);
  result.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  result.rmse = std::sqrt(square_sum / count);
  result.median = 0.5 * (sorted[(size - 1) / 2] + sorted[size / 2]);
  result.p95 = sorted[static_cast<std::size_t>(std::ceil(kHighShare * count)) - 1];
  result.std_dev = std::sqrt(std::max(0.0, square_sum / count - result.mean * result.mean));
  result.min = sorted.front();
  result.max = sorted.back();
  return result;
}

}  // namespace posefusion
