#pragma once

#include <string>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// A stretch of time in which no pose is expected, such as a fall. Both ends belong to it.
struct StampInterval {
  StampNs begin_ns = 0;
  StampNs end_ns = 0;
  std::string name;
};

/// Reads events.txt: a line `start_stamp end_stamp name` per interval, "#" starts a comment.
/// @throws std::runtime_error naming file and line for anything else, and an unreadable file.
std::vector<StampInterval> ReadIntervals(const std::string& path);

/// Whether an interval holds the stamp.
bool IsInside(StampNs stamp_ns, const std::vector<StampInterval>& intervals);

/// Whether an interval has a moment in common with [begin_ns, end_ns].
bool Overlaps(StampNs begin_ns, StampNs end_ns, const std::vector<StampInterval>& intervals);

}  // namespace posefusion
