#include "posefusion/evaluation/intervals.h"

#include <algorithm>
#include <stdexcept>

#include "posefusion/common/text_lines.h"

namespace posefusion {
namespace {

std::string JoinedFrom(const std::vector<std::string>& words, std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < words.size(); ++i) text += (i > first ? " " : "") + words[i];
  return text;
}

}  // namespace

std::vector<StampInterval> ReadIntervals(const std::string& path) {
  std::vector<StampInterval> intervals;
  for (const TextLine& line : ReadTextLines(path)) {
    const auto begin_ns = ParseStamp(line.columns[0]);
    const auto end_ns = line.columns.size() > 1 ? ParseStamp(line.columns[1]) : std::nullopt;
    if (!begin_ns || !end_ns || *end_ns < *begin_ns) {
      throw std::runtime_error(LineName(path, line) + ": expected 'start_stamp end_stamp name'");
    }
    intervals.push_back({*begin_ns, *end_ns, JoinedFrom(line.columns, 2)});
  }
  return intervals;
}

bool IsInside(StampNs stamp_ns, const std::vector<StampInterval>& intervals) {
  return Overlaps(stamp_ns, stamp_ns, intervals);
}

bool Overlaps(StampNs begin_ns, StampNs end_ns, const std::vector<StampInterval>& intervals) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const StampInterval& interval) {
    return begin_ns <= interval.end_ns && end_ns >= interval.begin_ns;
  });
}

}  // namespace posefusion
