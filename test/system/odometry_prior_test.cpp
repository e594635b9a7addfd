// Odometry of the simulated humanoid as a prior of tracking: right, wrong, and where frames are
// missing.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "posefusion/dataset/odometry_source.h"
#include "posefusion/evaluation/trajectory_evaluation.h"
#include "posefusion/pipeline/slam.h"
#include "posefusion/simulation/robot_record.h"
#include "posefusion/simulation/sim_source.h"

namespace posefusion {
namespace {

constexpr double kFaultS = 1.5;  ///< odometry goes wrong then
constexpr double kDelayS = 0.1;
/// Runs whose ATE differ by less are equally good: two noise seeds of one walk differ by as much.
constexpr double kAteNoiseM = 0.0005;

/// A humanoid that begins to walk around a table.
SimulationConfig Walk(double seconds, int seed) {
  SimulationConfig config;
  config.preset = "hrp_loop";
  config.seed = seed;
  config.humans = 0;
  config.seconds = seconds;
  return CheckedConfig(config);
}

using HintAt = std::function<FrameHints(double time_s)>;

/// One of several systems that see the same frames.
struct System {
  std::string name;
  HintAt hint_at;
  std::unique_ptr<Slam> slam = std::make_unique<Slam>(SlamConfig(), 2);
  int num_lost = 0;
  int num_used = 0;
  int num_wrong = 0;

  void Process(const RgbdFrame& frame) {
    const FrameResult result =
        slam->ProcessFrame(frame, {}, hint_at(SimulationTime(frame.stamp_ns)));
    if (!result.HasPose()) ++num_lost;
    if (result.tracking.prior == PriorUse::kUsed) ++num_used;
    if (result.tracking.prior == PriorUse::kContradicted) ++num_wrong;
  }
  double AteM(const Trajectory& truth) const {
    return EvaluateTrajectory(truth, slam->trajectory()).absolute.translation_m.rmse;
  }
};

FrameHints NoHint(double) { return {}; }

/// What the robot says; nothing before the first frame.
HintAt HintsOf(const RobotRecord& record) {
  const auto odometry = std::make_shared<RecordedOdometry>(CameraOdometry(record));
  return [odometry](double time_s) {
    return FrameHints{odometry->PoseAt(SimulationStamp(std::max(time_s, 0.0)))};
  };
}

/// A rotating, moving frame of odometry from kFaultS on.
HintAt Drifting(const HintAt& hint_at, double turn_radps, double speed_mps, double jump_m) {
  return [=](double time_s) {
    FrameHints hints = hint_at(time_s);
    const double since_s = time_s - kFaultS;
    if (since_s < 0) return hints;
    const Vector6d drift =
        (Vector6d() << jump_m + since_s * speed_mps, 0, 0, 0, 0, since_s * turn_radps).finished();
    hints.T_odom_camera = ExpSE3(drift) * *hints.T_odom_camera;
    return hints;
  };
}

TEST(OdometryPrior, WrongOdometryDoesNoHarm) {
  const SimulationConfig config = Walk(3.5, 1);
  const RobotRecord record = RecordRobot(config, MakeMover(config));
  const HintAt right = HintsOf(record);
  std::vector<System> runs;
  runs.push_back({"none", NoHint});
  runs.push_back({"right", right});
  runs.push_back({"slipping", Drifting(right, 0.3, 0.2, 0)});
  runs.push_back({"jumping", Drifting(right, 0, 0, 0.5)});
  runs.push_back({"frozen", [&](double time_s) { return right(std::min(time_s, kFaultS)); }});
  runs.push_back({"late", [&](double time_s) { return right(time_s - kDelayS); }});
  SimSource frames(config, 2);
  while (const auto frame = frames.Next()) {
    for (System& run : runs) run.Process(*frame);
  }
  const double without_m = runs.front().AteM(record.groundtruth);
  for (const System& run : runs) {
    EXPECT_EQ(run.num_lost, 0) << run.name;
    EXPECT_LT(run.AteM(record.groundtruth), without_m + kAteNoiseM) << run.name;
    EXPECT_EQ(run.num_used > 40, run.name != "none") << run.name;
    EXPECT_EQ(run.num_wrong > 0, run.name == "jumping") << run.name;
  }
}

TEST(OdometryPrior, BridgesHalfASecondWithoutFramesWhileTheHeadTurns) {
  constexpr int kTurningSeed = 23;
  constexpr double kGapS[2] = {1.8, 2.3};  // 0.26 rad and 0.12 m
  const SimulationConfig config = Walk(3, kTurningSeed);
  const RobotRecord record = RecordRobot(config, MakeMover(config));
  System with{"right", HintsOf(record)};
  System without{"none", NoHint};
  SimSource frames(config, 2);
  while (const auto frame = frames.Next()) {
    const double time_s = SimulationTime(frame->stamp_ns);
    if (time_s > kGapS[0] && time_s < kGapS[1]) continue;
    with.Process(*frame);
    without.Process(*frame);
  }
  EXPECT_GT(without.num_lost, 0) << "the gap is too easy to show anything";
  EXPECT_EQ(with.num_lost, 0);
  EXPECT_LT(with.AteM(record.groundtruth), 0.003);
}

}  // namespace
}  // namespace posefusion
