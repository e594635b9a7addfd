#include "posefusion/simulation/sweep_sequence.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

constexpr double kPi = 3.141592653589793;

}  // namespace

Vector6d SweepSequence::At(double time_s) const {
  const auto next = std::find_if(points_.begin(), points_.end(),
                                 [time_s](const Point& point) { return point.time_s > time_s; });
  if (next == points_.begin()) return points_.front().value;
  if (next == points_.end()) return points_.back().value;
  const Point& from = *(next - 1);
  const double u = (time_s - from.time_s) / (next->time_s - from.time_s);
  return from.value + 0.5 * (1 - std::cos(kPi * u)) * (next->value - from.value);
}

}  // namespace posefusion
