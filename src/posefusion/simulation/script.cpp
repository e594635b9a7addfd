#include "posefusion/simulation/script.h"

#include <cmath>

namespace posefusion {
namespace {

using Eigen::Vector2d;

constexpr double kForesight_s = 3;  ///< a place is left in time
constexpr double kLongestWait_s = 9;
constexpr double kAhead = 0.3;  ///< length of way that tells its direction, metres

}  // namespace

double YawOf(const Vector2d& direction) { return std::atan2(direction.y(), direction.x()); }

double WalkingTime(const std::vector<Vector2d>& way, double speed) {
  constexpr double kStartAndStop_s = 0.5;
  return LengthOf(way) / speed + kStartAndStop_s;
}

void Script::StandAt(const Vector2d& place, double yaw_rad, double duration_s, Gesture gesture) {
  segments_.push_back({Activity::kStand, now_s_, now_s_ + duration_s, {place}, yaw_rad, gesture});
  now_s_ += duration_s;
  here_ = place;
  yaw_rad_ = yaw_rad;
}

void Script::WalkAt(double depart_s, const std::vector<Vector2d>& way, double duration_s) {
  const double first_yaw = YawOf(PointAlong(way, kAhead) - way.front());
  StandAt(here_, first_yaw, depart_s - now_s_, Gesture::kNone);
  Walk(way, duration_s);
}

void Script::Walk(const std::vector<Vector2d>& way, double duration_s, Gesture gesture) {
  segments_.push_back({Activity::kWalk, now_s_, now_s_ + duration_s, way, 0, gesture});
  now_s_ += duration_s;
  here_ = way.back();
  yaw_rad_ = YawOf(way.back() - PointAlong(way, LengthOf(way) - kAhead));
}

bool Script::WalkTo(const Vector2d& goal, double speed, double stay_s, double margin) {
  const std::vector<Vector2d> way = stage_->grid.Way(here_, goal);
  if (way.empty() || LengthOf(way) < kAhead) return false;
  const Traffic& traffic = stage_->traffic;
  const double duration_s = WalkingTime(way, speed);
  double wait_s = kTurn_s;
  const auto fits = [&] {
    const double arrival_s = now_s_ + wait_s + duration_s;
    return !traffic.IsTaken(way, now_s_ + wait_s, duration_s, margin) &&
           !traffic.IsTaken(goal, arrival_s, arrival_s + stay_s + kForesight_s, kToCamera);
  };
  while (!fits()) {
    wait_s += 0.4;
    if (wait_s > kLongestWait_s) return false;
    if (traffic.IsTaken(here_, now_s_ + wait_s, now_s_ + wait_s, margin)) return false;
  }
  WalkAt(now_s_ + wait_s, way, duration_s);
  here_ = goal;
  return true;
}

void Script::Sit(const Seat& seat, double duration_s, Gesture gesture, bool still) {
  double end_s = now_s_ + duration_s;
  while (end_s < 2 * stage_->config.seconds &&
         stage_->traffic.IsTaken(seat.beside, end_s - 1, end_s + 5, kToCamera + 0.3)) {
    end_s += 1;
  }
  segments_.push_back(
      {Activity::kSit, now_s_, end_s, {seat.position}, seat.yaw_rad, gesture, still});
  now_s_ = end_s;
  StandAt(seat.beside, seat.yaw_rad, 2.2, Gesture::kNone);
}

}  // namespace posefusion
