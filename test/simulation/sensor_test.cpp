#include "posefusion/simulation/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "posefusion/simulation/color_sensor.h"
#include "test/simulation/turning_head.h"

namespace posefusion {
namespace {

using testing::QuarterCamera;
using testing::TurningHead;

SensorConfig SmallSensor() {
  SensorConfig config;
  config.camera = QuarterCamera();
  return config;
}

const World& SharedWorld() {
  static const World world([] {
    WorldConfig config;
    config.humans = 1;
    return config;
  }());
  return world;
}

bool AreEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

bool AreEqual(const SensorFrame& a, const SensorFrame& b) {
  return AreEqual(a.frame.rgb, b.frame.rgb) && AreEqual(a.frame.depth_m, b.frame.depth_m) &&
         AreEqual(a.labels, b.labels) && AreEqual(a.true_depth_m, b.true_depth_m) &&
         AreEqual(a.depth_true_depth_m, b.depth_true_depth_m) &&
         a.blur_length_px == b.blur_length_px;
}

TEST(Sensor, GivesTheSameBytesForTheSameSeedAndAnyThreads) {
  Sensor sensor(SmallSensor(), SharedWorld());
  const TurningHead head(1.0);
  const SensorFrame one = sensor.Capture(head, 0.5, 0.51, 7, ParallelRunner(1));
  sensor.Capture(head, 2.5, 2.5, 8, ParallelRunner(2));
  EXPECT_TRUE(AreEqual(one, sensor.Capture(head, 0.5, 0.51, 7, ParallelRunner(2))));
  EXPECT_FALSE(AreEqual(one, sensor.Capture(head, 0.5, 0.51, 8, ParallelRunner(2))));
}

TEST(Sensor, FramesAreWellFormedAndStamped) {
  Sensor sensor(SmallSensor(), SharedWorld());
  const SensorFrame frame = sensor.Capture(TurningHead(), 1.0, 1.02, 0, ParallelRunner(1));
  EXPECT_NO_THROW(CheckFrame(frame.frame, "simulated"));
  EXPECT_EQ(frame.frame.stamp_ns, 1'000'000'000);
  EXPECT_EQ(frame.frame.depth_stamp_ns, 1'020'000'000);
}

TEST(Sensor, DepthIsTakenAtItsOwnTime) {
  Sensor sensor(SmallSensor(), SharedWorld());
  const TurningHead head(1.0);
  const SensorFrame offset = sensor.Capture(head, 1.0, 1.1, 0, ParallelRunner(2));
  const SensorFrame later = sensor.Capture(head, 1.1, 1.1, 0, ParallelRunner(2));
  EXPECT_TRUE(AreEqual(offset.depth_true_depth_m, later.depth_true_depth_m));
  EXPECT_FALSE(AreEqual(offset.true_depth_m, later.true_depth_m));
}

TEST(Sensor, BlurGrowsWithExposureAndTurning) {
  SensorConfig config = SmallSensor();
  config.color.exposure_s = 0.02;
  Sensor sensor(config, SharedWorld());
  const auto blur = [&](double turn) {
    return sensor.Capture(TurningHead(turn), 1.0, 1.0, 0, ParallelRunner(2)).blur_length_px;
  };
  EXPECT_LT(blur(0), 0.3);
  // f w t in the middle, (1 + x^2) times that at the ray (x, y, 1): 9 % more at the median.
  const double expected = 1.09 * config.camera.fx * 3.0 * 0.02;
  EXPECT_NEAR(blur(3.0), expected, 0.15 * expected);
}

TEST(Sensor, RollingShutterSlantsUprightEdges) {
  SensorConfig config = SmallSensor();
  config.color.rolling_shutter = true;
  Sensor rolling(config, SharedWorld());
  Sensor global(SmallSensor(), SharedWorld());
  const TurningHead head(1.5);
  const cv::Mat a = rolling.Capture(head, 1.0, 1.0, 0, ParallelRunner(2)).true_depth_m;
  const cv::Mat b = global.Capture(head, 1.0, 1.0, 0, ParallelRunner(2)).true_depth_m;
  const auto difference = [&](int row) { return cv::norm(a.row(row), b.row(row), cv::NORM_L1); };
  EXPECT_GT(difference(0) + difference(119), 5 * (difference(59) + difference(60)));
}

TEST(ColorSensor, NoiseFollowsItsFormula) {
  const ColorSensorConfig config;
  CameraModel camera = QuarterCamera();
  ColorSensorConfig flat = config;
  flat.vignetting = 0;
  for (const double value : {0.05, 0.3, 0.8}) {
    const cv::Mat radiance(camera.height, camera.width, CV_32FC3, cv::Scalar::all(value));
    const cv::Mat image = ColorImage(flat, camera, radiance, 1.0, 77, ParallelRunner(2));
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(image, mean, deviation);
    const double grey = 255 * std::sqrt(value);
    // Of 255 sqrt(v), and the rounding to whole numbers.
    const auto noise = static_cast<double>(ColorNoise(config, static_cast<float>(value)));
    const double expected = std::sqrt(std::pow(noise * 127.5 / std::sqrt(value), 2) + 1.0 / 12);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], grey, 0.5);
      EXPECT_NEAR(deviation[c], expected, 0.05 * expected) << value;
    }
  }
}

TEST(ColorSensor, GainDriftsWithinItsBounds) {
  const ColorSensorConfig config;
  double least = 2;
  double most = 0;
  for (double t = 0; t < 60; t += 0.5) {
    least = std::min(least, GainAt(config, 3, t));
    most = std::max(most, GainAt(config, 3, t));
  }
  EXPECT_GT(least, 1 - config.gain_drift - 1e-9);
  EXPECT_LT(most, 1 + config.gain_drift + 1e-9);
  EXPECT_GT(most - least, config.gain_drift);
}

TEST(ColorSensor, CornersAreDarker) {
  const ColorSensorConfig config;
  const CameraModel camera = QuarterCamera();
  EXPECT_NEAR(LightLoss(config, camera, 80, 60), 1.0, 1e-3);
  EXPECT_NEAR(LightLoss(config, camera, 0, 0), 1 - config.vignetting, 0.01);
}

TEST(Sensor, RefusesValuesOutOfRange) {
  SensorConfig config = SmallSensor();
  config.color.exposure_s = 2;
  EXPECT_THROW(Sensor(config, SharedWorld()), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
