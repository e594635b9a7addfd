#pragma once

#include <algorithm>
#include <cmath>

namespace posefusion {

/// 0 before u = 0, 1 after u = 1, between them the minimum-jerk curve of human and robot reaching
/// (Flash and Hogan 1985): twice continuously differentiable.
inline double Ease(double u) {
  const double x = std::clamp(u, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

/// Damped oscillation that starts softly at `time_s` = 0 (value and slope are zero there):
/// what a blow leaves behind in an elastic structure. About 1 at its first peak.
inline double Ringing(double time_s, double frequency_hz, double decay_per_s) {
  constexpr double kTwoPi = 6.283185307179586;
  constexpr double kOnsetS = 0.01;
  if (time_s <= 0) return 0;
  return (1 - std::exp(-time_s / kOnsetS)) * std::exp(-decay_per_s * time_s) *
         std::sin(kTwoPi * frequency_hz * time_s);
}

}  // namespace posefusion
