#include "posefusion/common/stamp.h"

#include <cctype>
#include <cmath>
#include <cstdio>

namespace posefusion {
namespace {

constexpr StampNs kNanosecondsPerSecond = 1'000'000'000;
constexpr StampNs kNanosecondsPerMicrosecond = 1'000;
constexpr std::size_t kMaxSecondDigits = 10;
constexpr std::size_t kMaxDecimals = 9;

/// Value of a string of digits; empty for anything else.
std::optional<StampNs> ParseDigits(const std::string& digits) {
  StampNs value = 0;
  for (const char c : digits) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

}  // namespace

StampNs StampFromSeconds(double seconds) {
  return static_cast<StampNs>(std::llround(seconds / kSecondsPerNanosecond));
}

double ToSeconds(StampNs stamp_ns) {
  return static_cast<double>(static_cast<long double>(stamp_ns) / kNanosecondsPerSecond);
}

std::optional<StampNs> ParseStamp(const std::string& text) {
  const std::size_t dot = text.find('.');
  const std::string whole = text.substr(0, dot);
  std::string decimals = dot == std::string::npos ? "" : text.substr(dot + 1);
  if (whole.empty() || whole.size() > kMaxSecondDigits || decimals.size() > kMaxDecimals) {
    return std::nullopt;
  }
  decimals.append(kMaxDecimals - decimals.size(), '0');
  const auto seconds = ParseDigits(whole);
  const auto nanoseconds = ParseDigits(decimals);
  if (!seconds || !nanoseconds) return std::nullopt;
  return *seconds * kNanosecondsPerSecond + *nanoseconds;
}

std::string FormatStamp(StampNs stamp_ns) {
  const StampNs magnitude = stamp_ns < 0 ? -stamp_ns : stamp_ns;
  const long long seconds = magnitude / kNanosecondsPerSecond;
  const long long nanoseconds = magnitude % kNanosecondsPerSecond;
  const char* sign = stamp_ns < 0 ? "-" : "";
  char text[40];
  if (nanoseconds % kNanosecondsPerMicrosecond == 0) {
    std::snprintf(text, sizeof text, "%s%lld.%06lld", sign, seconds,
                  nanoseconds / kNanosecondsPerMicrosecond);
  } else {
    std::snprintf(text, sizeof text, "%s%lld.%09lld", sign, seconds, nanoseconds);
  }
  return text;
}

}  // namespace posefusion
