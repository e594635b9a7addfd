#include "posefusion_ros/gravity_finder.h"

#include <utility>

#include "posefusion/common/gravity.h"

namespace posefusion {

GravityFinder::GravityFinder(std::string odom_frame, const TfTree& tree, TroubleLog::Sink log_error)
    : odom_frame_(std::move(odom_frame)), tree_(tree), log_error_(std::move(log_error)) {}

std::optional<Eigen::Vector3f> GravityFinder::Find(StampNs stamp_ns,
                                                   const std::string& camera_frame,
                                                   double timeout_s, double now_s) {
  if (odom_frame_.empty()) return std::nullopt;
  const bool is_alive = !missed_ns_ || tree_.Find(odom_frame_, camera_frame, *missed_ns_);
  const auto T_odom_camera =
      tree_.WaitFor(odom_frame_, camera_frame, stamp_ns, is_alive ? timeout_s : 0);
  if (!T_odom_camera) {
    NoteMissing(stamp_ns, camera_frame, now_s);
    return std::nullopt;
  }
  missed_ns_.reset();
  missing_since_s_.reset();
  return GravityInCamera(*T_odom_camera);
}

void GravityFinder::NoteMissing(StampNs stamp_ns, const std::string& camera_frame, double now_s) {
  missed_ns_ = stamp_ns;
  if (!missing_since_s_) missing_since_s_ = now_s;
  if (now_s - *missing_since_s_ < kPatienceS) return;
  if (told_s_ && now_s - *told_s_ < kLogPeriodS) return;
  told_s_ = now_s;
  log_error_("no transform from " + odom_frame_ + " to " + camera_frame +
             " at the stamps of the images: " + tree_.WhyNot(odom_frame_, camera_frame, stamp_ns) +
             "; people are cut out without knowing where down is");
}

}  // namespace posefusion
