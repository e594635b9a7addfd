#include "posefusion/simulation/robot_motion.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

constexpr int kGazeStream = 303;
constexpr double kGazeIntervalS = 2.0;  ///< a new direction every so often
constexpr double kPitchRangeRad = 0.15;
constexpr double kFreezeBeforeFallS = 1.0;

/// Directions of the gaze; the neck stops while the robot falls and is carried.
UniformSpline<2> MakeGaze(const Route& route, const WalkPlanConfig& config,
                          const std::vector<Fall>& falls) {
  const IndexedRandom random(config.seed, kGazeStream);
  std::vector<Eigen::Vector2d> samples;
  const int num_samples = 2 + static_cast<int>(config.seconds / kGazeIntervalS);
  for (int i = 0; i < num_samples; ++i) {
    const double time_s = i * kGazeIntervalS;
    const bool frozen = std::any_of(falls.begin(), falls.end(), [time_s](const Fall& fall) {
      return time_s > fall.start_s - kFreezeBeforeFallS && time_s < fall.standing_s();
    });
    if (frozen && i > 0) {
      samples.push_back(samples.back());
      continue;
    }
    samples.emplace_back(route.gaze_yaw_rad + route.gaze_range_rad * random.Uniform(2 * i, -1, 1),
                         route.gaze_pitch_rad + kPitchRangeRad * random.Uniform(2 * i + 1, -1, 1));
  }
  return UniformSpline<2>(std::move(samples), kGazeIntervalS);
}

}  // namespace

RobotMotion::RobotMotion(const Route& route, const std::vector<Eigen::AlignedBox2d>& obstacles,
                         const WalkPlanConfig& plan, const GaitConfig& gait)
    : plan_(PlanWalk(route, obstacles, plan)),
      gait_(gait, plan.seed),
      gaze_(MakeGaze(route, plan, plan_.falls)) {}

double RobotMotion::SteppingAt(double time_s) const { return plan_.track.At(time_s)[3]; }

NeckAngles RobotMotion::NeckAt(double time_s) const {
  const Eigen::Vector2d gaze = gaze_.At(time_s);
  return {gaze.x(), gaze.y()};
}

Eigen::Isometry3d RobotMotion::T_map_footprint(double time_s) const {
  const auto value = plan_.track.At(time_s);
  Eigen::Isometry3d T(Eigen::Translation3d(value[0], value[1], 0));
  T.rotate(Eigen::AngleAxisd(value[2], Eigen::Vector3d::UnitZ()));
  return T;
}

Eigen::Isometry3d RobotMotion::T_footprint_tipped(double time_s) const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (const Fall& fall : plan_.falls) T = T * fall.T_footprint_tipped(time_s);
  return T;
}

Eigen::Isometry3d RobotMotion::T_footprint_measured_body(double time_s) const {
  return T_footprint_tipped(time_s) * Eigen::Translation3d(0, 0, kBodyHeightM) *
         gait_.T_standing_stepping(time_s, SteppingAt(time_s));
}

Shaking RobotMotion::ShakingAt(double time_s) const {
  return gait_.ShakingAt(time_s, [this](double t) { return SteppingAt(t); });
}

Eigen::Isometry3d RobotMotion::T_map_body(double time_s) const {
  return T_map_footprint(time_s) * T_footprint_measured_body(time_s) *
         ShakingAt(time_s).T_body_shaken();
}

Eigen::Isometry3d RobotMotion::T_map_camera(double time_s) const {
  return T_map_body(time_s) * ShakingAt(time_s).T_trunk_shaken() * T_body_camera(NeckAt(time_s));
}

}  // namespace posefusion
