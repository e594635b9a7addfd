#pragma once

#include <vector>

#include "posefusion/simulation/person_timeline.h"
#include "posefusion/simulation/stage.h"

namespace posefusion {

/// What one person does, one thing after the other. A copy is a state to come back to.
class Script {
 public:
  explicit Script(const Stage& stage) : stage_(&stage) {}

  double now_s() const { return now_s_; }
  const Eigen::Vector2d& here() const { return here_; }
  double yaw_rad() const { return yaw_rad_; }
  const std::vector<Segment>& segments() const { return segments_; }

  void StandAt(const Eigen::Vector2d& place, double yaw_rad, double duration_s, Gesture gesture);

  /// Stands here, turned towards the start of the way, and walks from depart_s on.
  void WalkAt(double depart_s, const std::vector<Eigen::Vector2d>& way, double duration_s);

  /// Walks at once, without turning before.
  void Walk(const std::vector<Eigen::Vector2d>& way, double duration_s,
            Gesture gesture = Gesture::kNone);

  /// Waits for a free way, goes there and could stay for a while without being in the way.
  bool WalkTo(const Eigen::Vector2d& goal, double speed, double stay_s, double margin = kToCamera);

  /// Sits down, or sits from the start, and gets up when nobody is in the way.
  void Sit(const Seat& seat, double duration_s, Gesture gesture, bool still);

 private:
  const Stage* stage_;
  std::vector<Segment> segments_;
  double now_s_ = 0;
  Eigen::Vector2d here_ = Eigen::Vector2d::Zero();
  double yaw_rad_ = 0;
};

double YawOf(const Eigen::Vector2d& direction);

/// Time to walk a way, with start and stop.
double WalkingTime(const std::vector<Eigen::Vector2d>& way, double speed);

}  // namespace posefusion
