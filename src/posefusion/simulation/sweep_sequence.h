#pragma once

#include <vector>

#include "posefusion/common/lie.h"

namespace posefusion {

/// Six values that go from one resting point to the next, each time along half a cosine wave:
/// continuous with its first derivative, constant before the first and after the last point.
class SweepSequence {
 public:
  explicit SweepSequence(const Vector6d& start) : points_{{0, start}} {}

  /// Goes on to `value` within `duration_s` > 0.
  void Append(const Vector6d& value, double duration_s) {
    points_.push_back({points_.back().time_s + duration_s, value});
  }

  double duration_s() const { return points_.back().time_s; }
  const Vector6d& last() const { return points_.back().value; }

  Vector6d At(double time_s) const;

 private:
  struct Point {
    double time_s;
    Vector6d value;
  };
  std::vector<Point> points_;
};

}  // namespace posefusion
