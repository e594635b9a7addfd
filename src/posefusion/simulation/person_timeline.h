#pragma once

#include <Eigen/Core>
#include <vector>

#include "posefusion/simulation/body.h"

namespace posefusion {

enum class Activity { kStand, kWalk, kSit };
enum class Gesture { kNone, kTalk, kWave, kPoint, kType, kPush };

/// What a person does for a while. Segments follow each other without gaps.
struct Segment {
  Activity activity = Activity::kStand;
  double from_s = 0;
  double to_s = 0;
  std::vector<Eigen::Vector2d> way;  ///< walked from end to end; one place for the rest
  double yaw_rad = 0;                ///< facing at the end
  Gesture gesture = Gesture::kNone;
  bool still = false;  ///< not the slightest motion
};

/// Length of a line in metres.
double LengthOf(const std::vector<Eigen::Vector2d>& way);
/// Point at a distance from the start; the ends stand for everything beyond them.
Eigen::Vector2d PointAlong(const std::vector<Eigen::Vector2d>& way, double distance_m);
/// Share of a way that is done after a share of its time: soft start and stop.
double WalkedShare(double time_share, double duration_s);

/// What one person does from the start of the run on; after the last segment it rests in the last
/// pose. A pure function of time.
class PersonTimeline {
 public:
  PersonTimeline(const BodyShape& shape, std::vector<Segment> segments);

  PersonPose At(double time_s) const;
  Eigen::Vector2d FloorAt(double time_s) const;

 private:
  Posture PostureAt(std::size_t segment, double time_s) const;
  Posture Walking(const Segment& segment, double time_s) const;
  Posture Resting(const Segment& segment, double time_s) const;
  std::size_t SegmentAt(double time_s) const;

  BodyShape shape_;
  std::vector<Segment> segments_;
};

}  // namespace posefusion
