#include "posefusion_ros/nodelets/mapping_diagnostics.h"

namespace posefusion {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// Keypoints this old are not carried over any more in most scenes.
constexpr float kOldMaskS = 2;

}  // namespace

void DescribeFrames(const Status& status, Diagnostics::Wrapper& entry) {
  entry.add("rate [Hz]", status.rate_hz);
  entry.add("delay from image to pose, median [s]", status.delay_median_s);
  entry.add("delay from image to pose, 95 % [s]", status.delay_p95_s);
  entry.add("waiting", status.queue_length);
  entry.add("processed", status.frames_processed);
  entry.add("dropped because newer ones waited", status.frames_dropped);
  entry.add("left out by human removal", status.frames_evicted);
  entry.add("refused", status.frames_refused);
  entry.add("resets", status.resets);
  if (status.state == "waiting") {
    entry.summary(DiagnosticStatus::WARN, "no frame has come yet");
  } else if (status.state == "no_data") {
    entry.summary(DiagnosticStatus::WARN, "frames have stopped coming. " + status.detail);
  } else if (status.state == "paused") {
    entry.summary(DiagnosticStatus::WARN, "paused");
  } else {
    entry.summaryf(DiagnosticStatus::OK, "%.1f poses per second", status.rate_hz);
  }
}

void DescribeTracking(const Status& status, Diagnostics::Wrapper& entry) {
  entry.add("health", status.health);
  entry.add("share of inliers", status.inlier_ratio);
  entry.add("share of pixels with depth", status.valid_ratio);
  entry.add("tracked", status.frames_tracked);
  entry.add("lost", status.frames_lost);
  entry.add("times lost", status.times_lost);
  entry.add("times found again", status.times_found);
  entry.add("surfels", status.surfels);
  entry.add("keyframes", status.keyframes);
  if (status.state == "lost") {
    entry.summary(DiagnosticStatus::ERROR, "lost: " + status.detail);
  } else if (status.health == "weak") {
    entry.summary(DiagnosticStatus::WARN, "some direction is poorly constrained");
  } else {
    entry.summary(DiagnosticStatus::OK, status.health.empty() ? "not started" : status.health);
  }
}

void DescribeTf(const Status& status, Diagnostics::Wrapper& entry) {
  if (status.tf_trouble.empty()) {
    entry.summary(DiagnosticStatus::OK, "the frames of the robot are known");
  } else {
    entry.summary(DiagnosticStatus::WARN, status.tf_trouble);
  }
}

void DescribePeople(const Status& status, Diagnostics::Wrapper& entry) {
  entry.add("people", status.people);
  entry.add("age of the mask [s]", status.mask_age_s);
  entry.add("keypoints [Hz]", status.keypoint_rate_hz);
  entry.add("delay of keypoints [s]", status.keypoint_delay_s);
  if (status.human_removal == 0) {
    entry.summary(DiagnosticStatus::OK, "people are not removed");
  } else if (status.mask_age_s < 0) {
    entry.summary(DiagnosticStatus::WARN, "no keypoints have come: people stay in the map");
  } else if (status.mask_age_s > kOldMaskS) {
    entry.summaryf(DiagnosticStatus::WARN, "the newest keypoints are %.1f s old",
                   static_cast<double>(status.mask_age_s));
  } else {
    entry.summaryf(DiagnosticStatus::OK, "%d people", status.people);
  }
}

void DescribeStages(const Status& status, Diagnostics::Wrapper& entry) {
  double total_ms = 0;
  for (std::size_t i = 0; i < status.stage_names.size(); ++i) {
    entry.add(status.stage_names[i] + " [ms]", status.stage_ms[i]);
    total_ms += status.stage_ms[i];
  }
  entry.summaryf(DiagnosticStatus::OK, "%.0f ms for the newest frame", total_ms);
}

}  // namespace posefusion
