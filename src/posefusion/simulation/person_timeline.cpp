#include "posefusion/simulation/person_timeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace posefusion {
namespace {

using Eigen::Vector2d;

constexpr double kBlend_s = 0.8;     // between standing, walking and gestures
constexpr double kSitBlend_s = 1.7;  // to sit down and to get up
constexpr double kSoftStart_s = 0.5;

double Ease(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

/// Angles of both legs and arms at a phase of the stride (right heel strikes at 0). Amplitudes
/// after the joint curves in Winter, "Biomechanics and Motor Control of Human Movement", ch. 4.
void AddStride(double phase, double strength, Posture& p) {
  const auto limb = [strength](double at, LimbAngles& leg, LimbAngles& other_arm) {
    const double swing = std::max(0.0, -std::sin(at - 0.35));
    leg.hip += strength * (0.08 + 0.40 * std::cos(at));
    leg.knee += strength * (0.10 + 0.95 * swing * swing);
    other_arm.shoulder += strength * (0.04 + 0.36 * std::cos(at));
    other_arm.elbow += strength * (0.28 + 0.14 * std::cos(at));
  };
  limb(phase, p.right, p.left);
  limb(phase + M_PI, p.left, p.right);
  p.twist += strength * 0.10 * std::cos(phase);
  p.sway += strength * 0.035 * std::sin(phase);
  p.lean += strength * 0.05;
}

void AddGesture(Gesture gesture, double t, Posture& p) {
  switch (gesture) {
    case Gesture::kTalk:
      p.right.shoulder += 0.45 + 0.18 * std::sin(2.1 * t);
      p.right.elbow += 1.35 + 0.4 * std::sin(3.3 * t + 1);
      p.left.shoulder += 0.25 + 0.15 * std::sin(1.7 * t);
      p.left.elbow += 1.1 + 0.35 * std::sin(2.6 * t);
      p.head_yaw += 0.25 * std::sin(0.9 * t);
      break;
    case Gesture::kWave:
      p.right.shoulder += 2.5;
      p.right.shoulder_out += 0.35 + 0.3 * std::sin(6.0 * t);
      p.right.elbow += 0.5 + 0.35 * std::sin(6.0 * t + 0.7);
      break;
    case Gesture::kPoint:
      p.right.shoulder += 1.35 + 0.05 * std::sin(1.3 * t);
      p.right.elbow += 0.2;
      p.head_pitch += 0.05;
      break;
    case Gesture::kType:
      p.lean += 0.16;
      p.head_pitch += 0.15;
      for (LimbAngles* arm : {&p.right, &p.left}) {
        arm->shoulder += 0.35;
        arm->elbow += 0.35;
        arm->shoulder_in += 0.25;
      }
      break;
    case Gesture::kPush:
      p.lean += 0.2;
      for (LimbAngles* arm : {&p.right, &p.left}) {
        arm->shoulder += 0.85;
        arm->elbow += 0.45;
      }
      break;
    case Gesture::kNone:
      break;
  }
}

/// The small motions of somebody who stands.
void AddIdle(double t, Posture& p) {
  p.sway += 0.012 * std::sin(0.7 * t);
  p.lean += 0.01 * std::sin(0.5 * t + 1);
  p.head_yaw += 0.12 * std::sin(0.37 * t) + 0.06 * std::sin(0.93 * t);
  p.right.shoulder += 0.03 * std::sin(0.8 * t);
}

Posture Upright(const Vector2d& floor, double yaw) {
  Posture p;
  p.floor = floor;
  p.yaw = yaw;
  p.right.shoulder_out = p.left.shoulder_out = 0.1;
  p.right.elbow = p.left.elbow = 0.12;
  return p;
}

void BendToSeat(Posture& p) {
  for (LimbAngles* leg : {&p.right, &p.left}) {
    leg->hip = 1.5;
    leg->hip_out = 0.1;
    leg->knee = 1.5;
  }
  p.lean = -0.06;
  p.right.shoulder = p.left.shoulder = 0.25;
  p.right.elbow = p.left.elbow = 0.7;
}

}  // namespace

double LengthOf(const std::vector<Vector2d>& way) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) length += (way[i + 1] - way[i]).norm();
  return length;
}

Vector2d PointAlong(const std::vector<Vector2d>& way, double distance_m) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double edge = (way[i + 1] - way[i]).norm();
    if (distance_m <= edge && edge > 0) {
      return way[i] + (way[i + 1] - way[i]) * std::max(distance_m, 0.0) / edge;
    }
    distance_m -= edge;
  }
  return way.back();
}

double WalkedShare(double time_share, double duration_s) {
  const double ramp = std::min(kSoftStart_s / std::max(duration_s, 1e-6), 0.5);
  const double s = std::clamp(time_share, 0.0, 1.0);
  const double speed = 1 / (1 - ramp);  // in the middle, so that the whole is 1
  if (s < ramp) return 0.5 * speed * s * s / ramp;
  if (s > 1 - ramp) return 1 - 0.5 * speed * (1 - s) * (1 - s) / ramp;
  return speed * (s - 0.5 * ramp);
}

PersonTimeline::PersonTimeline(const BodyShape& shape, std::vector<Segment> segments)
    : shape_(shape), segments_(std::move(segments)) {}

std::size_t PersonTimeline::SegmentAt(double time_s) const {
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), time_s,
                       [](double time, const Segment& segment) { return time < segment.from_s; });
  return after == segments_.begin() ? 0 : static_cast<std::size_t>(after - segments_.begin()) - 1;
}

Posture PersonTimeline::Walking(const Segment& segment, double time_s) const {
  const double duration = segment.to_s - segment.from_s;
  const double length = LengthOf(segment.way);
  const auto walked = [&](double time) {
    return length * WalkedShare((time - segment.from_s) / duration, duration);
  };
  const double distance = walked(time_s);
  const Vector2d ahead = PointAlong(segment.way, std::min(distance + 0.2, length));
  const Vector2d behind = PointAlong(segment.way, std::min(distance, length - 0.25) - 0.2);
  const Vector2d direction = ahead - behind;
  Posture p = Upright(PointAlong(segment.way, distance), std::atan2(direction.y(), direction.x()));
  const double speed = (walked(time_s + 0.02) - walked(time_s - 0.02)) / 0.04;
  const double stride = 0.78 * shape_.height;
  const double strength = std::min(1.0, speed / 1.0);
  AddStride(2 * M_PI * distance / stride, strength, p);
  AddGesture(segment.gesture, time_s, p);
  return p;
}

Posture PersonTimeline::Resting(const Segment& segment, double time_s) const {
  Posture p = Upright(segment.way.back(), segment.yaw_rad);
  if (segment.activity == Activity::kSit) BendToSeat(p);
  AddGesture(segment.gesture, segment.still ? 0 : time_s, p);
  if (!segment.still) AddIdle(time_s, p);
  return p;
}

Posture PersonTimeline::PostureAt(std::size_t index, double time_s) const {
  const Segment& segment = segments_[index];
  const Posture own =
      segment.activity == Activity::kWalk ? Walking(segment, time_s) : Resting(segment, time_s);
  if (index == 0) return own;
  // Start from how the segment before ended, as it would go on.
  const Segment& before = segments_[index - 1];
  const bool seat = (segment.activity == Activity::kSit) != (before.activity == Activity::kSit);
  const double blend = seat ? kSitBlend_s : kBlend_s;
  const double share = (time_s - segment.from_s) / blend;
  if (share >= 1) return own;
  const Posture last =
      before.activity == Activity::kWalk ? Walking(before, before.to_s) : Resting(before, time_s);
  Posture mixed = Blend(last, own, Ease(share));
  if (segment.activity == Activity::kWalk) mixed.floor = own.floor;
  return mixed;
}

PersonPose PersonTimeline::At(double time_s) const {
  return PoseBody(shape_, PostureAt(SegmentAt(time_s), time_s));
}

Vector2d PersonTimeline::FloorAt(double time_s) const {
  return PostureAt(SegmentAt(time_s), time_s).floor;
}

}  // namespace posefusion
