#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/simulation/fall.h"

namespace posefusion {

/// A stretch of a run in which no pose can be expected: a line of events.txt.
struct SimulationEvent {
  StampNs begin_ns = 0;
  StampNs end_ns = 0;
  std::string name;
};

/// Below this share of pixels that show no person a view counts as fully occluded.
constexpr double kOccludedStaticShare = 0.1;

/// Share of the pixels of a label image that do not show a person, counted on every eighth row and
/// column.
double StaticShare(const cv::Mat& labels);

/// Joins frames without a view of the room to intervals. Frames come in the order of their stamps.
class OcclusionRecorder {
 public:
  void Add(StampNs stamp_ns, double static_share);

  const std::vector<SimulationEvent>& events() const { return events_; }

 private:
  std::vector<SimulationEvent> events_;
};

/// Falls, from losing balance to standing again, as events.
std::vector<SimulationEvent> FallEvents(const std::vector<Fall>& falls);

/// The text of events.txt, in order of time: lines `start_stamp end_stamp name`.
std::string FormatEvents(std::vector<SimulationEvent> events);

}  // namespace posefusion
