#pragma once

#include <cmath>

namespace posefusion {

/// True when a network that looks at `rate_hz` images a second looks at the image of `time_s`, the
/// one before it being of `previous_s`: at the first image of each period since time 0. A rate of 0
/// means every image.
inline bool IsDue(double time_s, double previous_s, double rate_hz) {
  constexpr double kRounding = 1e-3;  // of a period: stamps are rounded
  if (rate_hz <= 0) return true;
  const auto period_of = [&](double t) { return std::floor(t * rate_hz + kRounding); };
  return period_of(time_s) != period_of(previous_s);
}

}  // namespace posefusion
