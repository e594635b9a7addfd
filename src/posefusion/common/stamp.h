#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace posefusion {

/// Time since the Unix epoch (or since simulation start) in nanoseconds, as in ROS.
using StampNs = std::int64_t;

constexpr double kSecondsPerNanosecond = 1e-9;

/// Difference later - earlier in seconds.
inline double SecondsBetween(StampNs earlier, StampNs later) {
  return static_cast<double>(later - earlier) * kSecondsPerNanosecond;
}

StampNs StampFromSeconds(double seconds);

/// The double nearest to the stamp in seconds: exact to about 0.2 us for times of today.
double ToSeconds(StampNs stamp_ns);

/// Reads decimal seconds ("1305031102.175304") exactly, digit by digit; at most nine decimals.
/// Empty when the text is anything else.
std::optional<StampNs> ParseStamp(const std::string& text);

/// Decimal seconds with six decimals, nine where the stamp has nanoseconds.
std::string FormatStamp(StampNs stamp_ns);

}  // namespace posefusion
