#include "posefusion_ros/robot_locator.h"

#include <algorithm>
#include <utility>

namespace posefusion {
namespace {

/// Steps longer than this say nothing about a jump: the robot may have gone there.
constexpr double kMaxStepS = 0.5;

}  // namespace

std::vector<LocatedPose> RobotLocator::Take(Clock::time_point now) {
  std::vector<LocatedPose> done;
  while (!waiting_.empty()) {
    const Waiting& first = waiting_.front();
    LocatedPose located = Locate(first.pose);
    const bool complete = IsComplete(located);
    if (!complete && now - first.since < std::chrono::duration<double>(tf_.wait_s)) break;
    trouble_ = refusal_;
    if (!complete) NoteMissing(located);
    if (located.child && !frames_.odom_frame.empty()) {
      NoteJump(located.pose, located.child->T_map_child.inverse() * located.pose.T_map_camera);
    }
    done.push_back(std::move(located));
    waiting_.pop_front();
  }
  return done;
}

LocatedPose RobotLocator::Locate(const TrackedPose& pose) {
  const auto find = [&](const std::string& frame) {
    return frame.empty() ? Eigen::Isometry3d::Identity()
                         : tree_.Find(pose.camera_frame, frame, pose.stamp_ns);
  };
  LocatedPose located;
  located.pose = pose;
  located.T_camera_head = find(frames_.head_frame);
  located.T_camera_base = find(frames_.base_frame);
  located.child = FindChild(pose);
  return located;
}

bool RobotLocator::IsComplete(const LocatedPose& located) const {
  const bool has_child = located.child.has_value() || !refusal_.empty();
  return located.T_camera_head && located.T_camera_base && has_child;
}

std::optional<MapChild> RobotLocator::FindChild(const TrackedPose& pose) {
  refusal_.clear();
  auto child = frames_.odom_frame.empty() ? FindRoot(pose) : FindOdom(pose);
  return refusal_.empty() ? child : std::nullopt;
}

std::optional<MapChild> RobotLocator::FindOdom(const TrackedPose& pose) {
  const std::string odom = TfName(frames_.odom_frame);
  const std::string map = TfName(frames_.map_frame);
  const auto above_map = tree_.ChainOf(map);
  if (std::find(above_map.begin(), above_map.end(), odom) != above_map.end()) {
    refusal_ = "tf says that " + map + " hangs below " + odom + ": " + map + " -> " + odom +
               " would close a loop and is not published";
  } else if (const auto link = tree_.LinkOf(odom)) {
    refusal_ = odom + " has the parent " + link->parent + " already (published by " +
               link->publisher + "): " + map + " -> " + odom +
               " is not published; a frame has one parent only";
  }
  const auto T_odom_camera = OdomToCamera(pose.stamp_ns, pose.camera_frame);
  if (!T_odom_camera) return std::nullopt;
  return MapChild{odom, pose.T_map_camera * T_odom_camera->inverse()};
}

std::optional<MapChild> RobotLocator::FindRoot(const TrackedPose& pose) {
  const std::string map = TfName(frames_.map_frame);
  const auto chain = tree_.ChainOf(pose.camera_frame);
  if (std::find(chain.begin(), chain.end(), map) != chain.end()) {
    const auto below = std::find(chain.begin(), chain.end(), map) - 1;
    const auto link = tree_.LinkOf(*below);
    refusal_ = "somebody else says where " + pose.camera_frame + " is in " + map + " (" + *below +
               " by " + (link ? link->publisher : "nobody") + "): nothing is published";
    return std::nullopt;
  }
  const auto T_camera_root = tree_.Find(pose.camera_frame, chain.back(), pose.stamp_ns);
  if (!T_camera_root) return std::nullopt;
  return MapChild{chain.back(), pose.T_map_camera * *T_camera_root};
}

std::optional<Eigen::Isometry3d> RobotLocator::OdomToCamera(StampNs stamp_ns,
                                                            const std::string& camera_frame) const {
  if (frames_.odom_frame.empty()) return std::nullopt;
  return tree_.Find(frames_.odom_frame, camera_frame, stamp_ns);
}

void RobotLocator::NoteMissing(const LocatedPose& located) {
  const TrackedPose& pose = located.pose;
  const auto note = [&](const std::string& frame) {
    trouble_ =
        "no transform from " + frame + " to " + pose.camera_frame +
        " at the stamps of the images: " + tree_.WhyNot(frame, pose.camera_frame, pose.stamp_ns);
  };
  if (!located.T_camera_head) note(frames_.head_frame);
  if (!located.T_camera_base) note(frames_.base_frame);
  if (located.child || !refusal_.empty()) return;
  note(frames_.odom_frame.empty() ? tree_.ChainOf(pose.camera_frame).back() : frames_.odom_frame);
}

/// Where odometry and tracking disagree, one of them has jumped; tracking checks its own steps.
void RobotLocator::NoteJump(const TrackedPose& pose, const Eigen::Isometry3d& T_odom_camera) {
  if (last_ && SecondsBetween(last_->pose.stamp_ns, pose.stamp_ns) < kMaxStepS) {
    const auto step = [](const Eigen::Isometry3d& from,
                         const Eigen::Isometry3d& to) -> Eigen::Vector3d {
      return (from.inverse() * to).translation();
    };
    const double jump_m = (step(last_->T_odom_camera, T_odom_camera) -
                           step(last_->pose.T_map_camera, pose.T_map_camera))
                              .norm();
    if (jump_m > tf_.max_odometry_jump_m) {
      trouble_ = frames_.odom_frame + " jumped by " + std::to_string(jump_m) +
                 " m: " + frames_.map_frame + " -> " + frames_.odom_frame + " follows";
    }
  }
  last_ = Step{pose, T_odom_camera};
}

void RobotLocator::Reset() {
  waiting_.clear();
  last_.reset();
  refusal_.clear();
  trouble_.clear();
}

}  // namespace posefusion
