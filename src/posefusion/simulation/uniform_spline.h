#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace posefusion {

/// Twice continuously differentiable curve near equally spaced samples: a uniform cubic B-spline
/// with the samples as its control points. Constant before the first and after the last sample.
template <int kDimension>
class UniformSpline {
 public:
  using Value = Eigen::Matrix<double, kDimension, 1>;

  /// The sample at index i belongs to time i * interval_s.
  UniformSpline(std::vector<Value> samples, double interval_s)
      : samples_(std::move(samples)), interval_s_(interval_s) {
    if (samples_.empty() || !(interval_s > 0)) {
      throw std::invalid_argument("a spline needs samples and a positive interval");
    }
  }

  Value At(double time_s) const {
    const double last = static_cast<double>(samples_.size());
    const double position = std::clamp(time_s / interval_s_, -1.0, last);
    const double base = std::floor(position);
    const double u = position - base;
    const auto i = static_cast<long>(base);
    const double v = 1 - u;
    return (v * v * v * Sample(i - 1) + (3 * u * u * u - 6 * u * u + 4) * Sample(i) +
            (3 * v * v * v - 6 * v * v + 4) * Sample(i + 1) + u * u * u * Sample(i + 2)) /
           6;
  }

 private:
  const Value& Sample(long i) const {
    return samples_[static_cast<std::size_t>(
        std::clamp(i, 0L, static_cast<long>(samples_.size()) - 1))];
  }

  std::vector<Value> samples_;
  double interval_s_;
};

}  // namespace posefusion
