#include "posefusion/simulation/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "test/simulation/turning_head.h"

namespace posefusion {
namespace {

using testing::QuarterCamera;
using testing::TurningHead;

/// One world for all tests: it takes a second to make.
const World& SharedWorld() {
  static const World world([] {
    WorldConfig config;
    config.humans = 2;
    return config;
  }());
  return world;
}

Renderer& SharedRenderer() {
  static Renderer renderer(SharedWorld());
  return renderer;
}

bool AreEqual(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int row = 0; row < a.rows; ++row) {
    if (std::memcmp(a.ptr(row), b.ptr(row), a.elemSize() * static_cast<std::size_t>(a.cols)) != 0) {
      return false;
    }
  }
  return true;
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Differences between what view A and view B say about the same static surfaces.
struct Comparison {
  std::vector<double> depth_m;
  std::vector<double> color;  ///< of 255 * sqrt(linear)
};

Comparison Compare(const View& a, const Eigen::Isometry3d& T_map_a, const View& b,
                   const Eigen::Isometry3d& T_map_b, const CameraModel& camera) {
  Comparison result;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if (a.labels.at<std::uint8_t>(y, x) != kLabelStatic) continue;
      const auto z = static_cast<double>(a.depth_m.at<float>(y, x));
      const Eigen::Vector3d p_b = T_map_b.inverse() * T_map_a * camera.Unproject(x, y, z);
      if (p_b.z() < 0.1) continue;
      const Eigen::Vector2d pixel = camera.Project(p_b);
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
      if (b.labels.at<std::uint8_t>(v, u) != kLabelStatic) continue;
      const double difference = static_cast<double>(b.depth_m.at<float>(v, u)) - p_b.z();
      if (std::abs(difference) > 0.1) continue;  // hidden from B
      result.depth_m.push_back(std::abs(difference));
      const cv::Vec3f color_a = a.radiance.at<cv::Vec3f>(y, x);
      const cv::Vec3f color_b = b.radiance.at<cv::Vec3f>(v, u);
      result.color.push_back(
          255 * std::abs(std::sqrt(double(color_a[1])) - std::sqrt(double(color_b[1]))));
    }
  }
  return result;
}

TEST(Renderer, DepthAndColorOfOneViewAgreeWithAnother) {
  const ParallelRunner runner(2);
  const TurningHead head(0.15);
  const CameraModel camera{320, 240, 262.5, 262.5, 159.5, 119.5, {}};
  const View a = SharedRenderer().Render(camera, head.T_map_camera(0), 0, runner);
  const View b = SharedRenderer().Render(camera, head.T_map_camera(0.6), 0.6, runner);
  const Comparison difference = Compare(a, head.T_map_camera(0), b, head.T_map_camera(0.6), camera);
  ASSERT_GT(difference.depth_m.size(), 20000U);
  EXPECT_LT(Median(difference.depth_m), 0.002);
  EXPECT_LT(Median(difference.color), 3.0);
}

TEST(Renderer, DepthIsExactOnAPlaneOfTheRoom) {
  const ParallelRunner runner(1);
  const CameraModel camera = QuarterCamera();
  const TurningHead head(0, 0.0);  // towards the blank wall x = 3
  const Eigen::Isometry3d T = head.T_map_camera(0);
  const View view = SharedRenderer().Render(camera, T, 0, runner);
  int on_wall = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const auto z = static_cast<double>(view.depth_m.at<float>(y, x));
      const Eigen::Vector3d p_map = T * camera.Unproject(x, y, z);
      if (p_map.z() < 2.5 && p_map.y() > -1.0 && p_map.y() < 1.0) {
        if (view.labels.at<std::uint8_t>(y, x) != kLabelStatic) continue;
        EXPECT_NEAR(p_map.x(), 3.0, 1e-4);
        ++on_wall;
      }
    }
  }
  EXPECT_GT(on_wall, 500);
}

TEST(Renderer, LabelsJointsAndDepthAgree) {
  const ParallelRunner runner(2);
  const CameraModel camera = QuarterCamera();
  const TurningHead head;
  int seen = 0;
  int labelled = 0;
  for (double t = 0; t < 30; t += 1.3) {
    const Eigen::Isometry3d T_map_camera = head.T_map_camera(t);
    const View view = SharedRenderer().Render(camera, T_map_camera, t, runner);
    for (int person = 0; person < 2; ++person) {
      for (const Eigen::Vector3d& joint : SharedWorld().PersonAt(person, t).joints) {
        const Eigen::Vector3d p = T_map_camera.inverse() * joint;
        if (p.z() < 0.3) continue;
        const Eigen::Vector2d pixel = camera.Project(p);
        const int u = static_cast<int>(std::lround(pixel.x()));
        const int v = static_cast<int>(std::lround(pixel.y()));
        if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
        const auto z = static_cast<double>(view.depth_m.at<float>(v, u));
        if (z < p.z() - 0.25) continue;  // somebody or something else is in front
        ++seen;
        if (view.labels.at<std::uint8_t>(v, u) != kLabelPerson + person) continue;
        ++labelled;
        EXPECT_LT(z, p.z() + 0.06) << "the skin is in front of a joint";
      }
    }
  }
  EXPECT_GT(seen, 100);
  EXPECT_GT(labelled, 0.9 * seen);
}

TEST(Renderer, GivesTheSameBytesForAnyNumberOfThreads) {
  const CameraModel camera = QuarterCamera();
  const TurningHead head(1.5);
  const Exposure exposure{9.99, 10.01, 0.02, 24};
  const ExposedView one = SharedRenderer().Expose(camera, head, exposure, ParallelRunner(1));
  const ExposedView two = SharedRenderer().Expose(camera, head, exposure, ParallelRunner(2));
  Renderer fresh(SharedWorld());
  const ExposedView again = fresh.Expose(camera, head, exposure, ParallelRunner(2));
  for (const ExposedView* view : {&two, &again}) {
    EXPECT_TRUE(AreEqual(one.radiance, view->radiance));
    EXPECT_TRUE(AreEqual(one.middle.depth_m, view->middle.depth_m));
    EXPECT_TRUE(AreEqual(one.middle.labels, view->middle.labels));
    EXPECT_TRUE(AreEqual(one.motion_px, view->motion_px));
  }
}

TEST(Renderer, MeasuresTheMotionOfATurningCamera) {
  const ParallelRunner runner(2);
  const CameraModel camera = QuarterCamera();
  const TurningHead head(2.0);
  const ExposedView view = SharedRenderer().Expose(camera, head, {-0.01, 0.01, 0.02, 24}, runner);
  // In the middle of the image a turn by w about an upright axis moves the view by f w cos(pitch).
  const double expected = camera.fx * 2.0 * 0.02 * std::cos(0.25);
  EXPECT_NEAR(static_cast<double>(view.motion_px.at<float>(14, 20)), expected, 0.1 * expected);
  cv::Mat gradient_sharp =
      view.middle.radiance.colRange(1, 160) - view.middle.radiance.colRange(0, 159);
  cv::Mat gradient_blurred = view.radiance.colRange(1, 160) - view.radiance.colRange(0, 159);
  EXPECT_LT(cv::norm(gradient_blurred), 0.8 * cv::norm(gradient_sharp));
  EXPECT_NEAR(cv::mean(view.radiance)[1], cv::mean(view.middle.radiance)[1], 0.02);
}

TEST(Renderer, TakesOneViewWhereNothingMoves) {
  const ParallelRunner runner(2);
  class Still : public TurningHead {
   public:
    Eigen::Isometry3d T_map_camera(double) const override { return TurningHead::T_map_camera(0); }
  };
  const WorldConfig empty;
  const World world(empty);
  Renderer renderer(world);
  const ExposedView view =
      renderer.Expose(QuarterCamera(), Still(), {-0.01, 0.01, 0.02, 24}, runner);
  EXPECT_TRUE(AreEqual(view.radiance, view.middle.radiance));
  EXPECT_LT(cv::norm(view.motion_px, cv::NORM_INF), 1e-3);
}

TEST(Renderer, BendsTheImageOfADistortedCamera) {
  const ParallelRunner runner(1);
  CameraModel distorted = QuarterCamera();
  distorted.distortion = {0.1, -0.05, 0, 0, 0};
  const TurningHead head;
  const View bent = SharedRenderer().Render(distorted, head.T_map_camera(0), 0, runner);
  const View straight = SharedRenderer().Render(QuarterCamera(), head.T_map_camera(0), 0, runner);
  EXPECT_NEAR(bent.depth_m.at<float>(60, 80), straight.depth_m.at<float>(60, 80), 0.01F);
  EXPECT_FALSE(AreEqual(bent.depth_m, straight.depth_m));
}

}  // namespace
}  // namespace posefusion
