// The true blur of simulated frames, and the blur filter on a simulated fall.

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "posefusion/evaluation/blur_evaluation.h"
#include "posefusion/image/blur_filter.h"
#include "posefusion/simulation/color_sensor.h"
#include "posefusion/simulation/exposure.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {
namespace {

/// Less than is asked of long runs: a fall has few frames, and most of them move.
constexpr double kMinRecall = 0.85;
constexpr int kMaxFalseDrops = 2;
constexpr double kMaxStillDropS = 0.2;

TEST(TrueBlurLength, IsTheMedianOverTheImage) {
  const cv::Mat motion_px = (cv::Mat_<float>(1, 5) << 9, 1, 2, 3, 9);
  EXPECT_EQ(TrueBlurLength(motion_px), 3);
  EXPECT_EQ(TrueBlurLength(cv::Mat()), 0);
}

/// The frames around the first fall of a run, without depth.
std::vector<JudgedFrame> JudgeFirstFall(const SimulationConfig& config, BlurFilter& filter) {
  const Mover mover = MakeMover(config);
  const World world(MakeWorldConfig(config, mover));
  Renderer renderer(world);
  const ParallelRunner runner(2);
  const ColorSensorConfig& color = config.sensor.color;
  const auto first = static_cast<int>((mover.robot->falls().at(0).start_s - 0.3) * kFrameRateHz);
  std::vector<JudgedFrame> frames;
  for (int i = first; i < first + 60; ++i) {
    const double time_s = i / kFrameRateHz;
    const Exposure exposure{time_s - 0.5 * color.exposure_s, time_s + 0.5 * color.exposure_s,
                            color.exposure_s, color.max_sub_exposures};
    const ExposedView view = renderer.Expose(config.sensor.camera, *mover.head, exposure, runner);
    const cv::Mat rgb = ColorImage(color, config.sensor.camera, view.radiance, 1.0,
                                   static_cast<std::uint32_t>(i), runner);
    const StampNs stamp_ns = SimulationStamp(time_s);
    frames.push_back({stamp_ns, TrueBlurLength(view.motion_px), !filter.Judge(rgb, stamp_ns).keep});
  }
  return frames;
}

TEST(SimulatedBlur, DefaultFilterDropsTheBlurOfAFall) {
  SimulationConfig config;
  config.preset = "hrp_falls";
  config.humans = 1;
  config.seed = 21;
  config.seconds = 12;
  BlurFilter filter{BlurFilterConfig()};
  const auto frames = JudgeFirstFall(CheckedConfig(config), filter);
  const BlurEvaluation evaluation = EvaluateBlur(frames, {}, {});
  EXPECT_GE(evaluation.all.num_blurred, 10);
  EXPECT_GE(evaluation.all.num_sharp, 20);
  EXPECT_GE(evaluation.all.Recall(), kMinRecall) << FormatTable(evaluation, {});
  EXPECT_LE(evaluation.all.num_false, kMaxFalseDrops) << FormatTable(evaluation, {});
  EXPECT_LE(evaluation.longest_still_drop_s, kMaxStillDropS);
}

}  // namespace
}  // namespace posefusion
