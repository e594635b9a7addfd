#include "posefusion_ros/nodelets/mapping_status.h"

#include <ros/time.h>

namespace posefusion {
namespace {

constexpr double kIdlePeriodS = 1;

}  // namespace

MappingStatus::MappingStatus() : last_s_(SteadyNowS()) { status_.state = "waiting"; }

Status MappingStatus::OfFrame(const FrameResult& result, const std_msgs::Header& rgb_header,
                              const Slam& slam, const MappingCounts& counts,
                              const std::string& tf_trouble) {
  const TrackingResult& tracking = result.tracking;
  status_.header.stamp = rgb_header.stamp;
  status_.header.frame_id = rgb_header.frame_id;
  status_.state = result.HasPose() ? "tracking" : "lost";
  status_.detail = tracking.failure;
  status_.health = ToString(tracking.health);
  status_.inlier_ratio = tracking.inlier_ratio;
  status_.valid_ratio = tracking.valid_ratio;
  status_.icp_rms_m = tracking.icp_rms_m;
  status_.intensity_rms = tracking.intensity_rms;
  status_.surfels = slam.NumSurfels();
  status_.keyframes = static_cast<std::uint64_t>(slam.NumKeyframes());
  status_.delay_s = (ros::Time::now() - rgb_header.stamp).toSec();
  status_.tf_trouble = tf_trouble;
  FillPace(result.HasPose());
  status_.stage_names.clear();
  status_.stage_ms.clear();
  for (const auto& time : result.stage_times) {
    status_.stage_names.emplace_back(time.stage);
    status_.stage_ms.push_back(time.milliseconds);
  }
  FillCounts(counts);
  FillPeople(counts.human_info);
  last_s_ = SteadyNowS();
  return status_;
}

std::optional<Status> MappingStatus::OfIdle(const MappingCounts& counts) {
  const double now_s = SteadyNowS();
  if (now_s - last_s_ < kIdlePeriodS) return std::nullopt;
  last_s_ = now_s;
  FillCounts(counts);
  if (status_.frames_processed > 0) status_.state = "no_data";
  if (counts.paused) status_.state = "paused";
  FillPace(false);
  if (!counts.trouble.empty()) status_.detail = counts.trouble;
  return status_;
}

void MappingStatus::FillPace(bool has_pose) {
  const double now_s = SteadyNowS();
  if (has_pose) pace_.Note(now_s, status_.delay_s);
  status_.rate_hz = pace_.RateHz(now_s);
  status_.delay_median_s = pace_.DelayQuantileS(0.5);
  status_.delay_p95_s = pace_.DelayQuantileS(0.95);
}

void MappingStatus::FillCounts(const MappingCounts& counts) {
  status_.frames_processed = counts.processed;
  status_.frames_tracked = counts.tracked;
  status_.frames_lost = counts.processed - counts.tracked;
  status_.times_lost = counts.times_lost;
  status_.times_found = counts.times_found;
  status_.frames_refused = counts.refused;
  status_.frames_dropped = counts.dropped;
  status_.resets = counts.resets;
  status_.queue_length = static_cast<std::uint32_t>(counts.queue_length + counts.held);
  status_.frames_evicted = counts.evicted;
}

void MappingStatus::FillPeople(const HumanInfoConstPtr& info) {
  status_.human_removal = static_cast<std::uint8_t>(info && info->removal_enabled);
  if (!info) return;
  status_.people = info->num_people;
  status_.mask_age_s = info->mask_age_s;
  status_.keypoint_rate_hz = info->keypoint_rate_hz;
  status_.keypoint_delay_s = info->keypoint_delay_s;
}

}  // namespace posefusion
