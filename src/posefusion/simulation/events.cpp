#include "posefusion/simulation/events.h"

#include <algorithm>
#include <cstdint>

#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {
namespace {

constexpr int kStride = 8;
constexpr double kMaxGapS = 0.2;  ///< shorter sights of the room between two occlusions do not help

}  // namespace

double StaticShare(const cv::Mat& labels) {
  int num_static = 0;
  int num_pixels = 0;
  for (int v = kStride / 2; v < labels.rows; v += kStride) {
    for (int u = kStride / 2; u < labels.cols; u += kStride) {
      ++num_pixels;
      if (labels.at<std::uint8_t>(v, u) < kLabelPerson) ++num_static;
    }
  }
  return num_pixels > 0 ? static_cast<double>(num_static) / num_pixels : 1;
}

void OcclusionRecorder::Add(StampNs stamp_ns, double static_share) {
  if (static_share >= kOccludedStaticShare) return;
  if (!events_.empty() && SecondsBetween(events_.back().end_ns, stamp_ns) <= kMaxGapS) {
    events_.back().end_ns = stamp_ns;
  } else {
    events_.push_back({stamp_ns, stamp_ns, "occlusion"});
  }
}

std::vector<SimulationEvent> FallEvents(const std::vector<Fall>& falls) {
  std::vector<SimulationEvent> events;
  for (const Fall& fall : falls) {
    events.push_back({SimulationStamp(fall.start_s), SimulationStamp(fall.standing_s()), "fall"});
  }
  return events;
}

std::string FormatEvents(std::vector<SimulationEvent> events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.begin_ns < b.begin_ns; });
  std::string text = "# start_stamp end_stamp name; no pose is expected in between\n";
  for (const SimulationEvent& event : events) {
    text += FormatStamp(event.begin_ns) + " " + FormatStamp(event.end_ns) + " " + event.name + "\n";
  }
  return text;
}

}  // namespace posefusion
