#include "posefusion/image/camera_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>
#include <stdexcept>

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kTolerancePx = 1e-9;  ///< a few roundings of doubles of about 1000

CameraModel Freiburg1() {
  CameraModel camera{640, 480, 517.306408, 516.469215, 318.643040, 255.313989, {}};
  camera.distortion = {0.262383, -0.953104, -0.005358, 0.002628, 1.163314};
  return camera;
}

/// A value in [low, high] with a resolution of a thousandth of the range.
double Between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
}

TEST(CameraModel, ProjectionUndoesUnprojection) {
  EXPECT_TRUE(rc::check([] {
    const Eigen::Vector2d pixel(Between(-50, 700), Between(-50, 500));
    const double z = Between(0.1, 10);
    const Eigen::Vector3d p_camera = Freiburg1().Unproject(pixel.x(), pixel.y(), z);
    RC_ASSERT(p_camera.z() == z);
    RC_ASSERT((Freiburg1().Project(p_camera) - pixel).norm() < kTolerancePx);
  }));
}

TEST(CameraModel, LevelSeesTheMeanOfFourPixels) {
  EXPECT_TRUE(rc::check([] {
    const int u = *rc::gen::inRange(0, 320);
    const int v = *rc::gen::inRange(0, 240);
    const Eigen::Vector3d centre = Freiburg1().Unproject(2 * u + 0.5, 2 * v + 0.5, 1.5);
    const Eigen::Vector2d pixel = Freiburg1().AtLevel(1).Project(centre);
    RC_ASSERT((pixel - Eigen::Vector2d(u, v)).norm() < kTolerancePx);
  }));
}

TEST(CameraModel, LevelsAddUp) {
  EXPECT_EQ(Freiburg1().AtLevel(0), Freiburg1());
  EXPECT_EQ(Freiburg1().AtLevel(1).AtLevel(1), Freiburg1().AtLevel(2));
  EXPECT_EQ(Freiburg1().AtLevel(2).width, 160);
}

TEST(CameraModel, UndistortedKeepsThePinhole) {
  EXPECT_TRUE(Freiburg1().HasDistortion());
  EXPECT_FALSE(Freiburg1().Undistorted().HasDistortion());
  EXPECT_EQ(Freiburg1().Undistorted().fx, Freiburg1().fx);
  EXPECT_NE(Freiburg1().Undistorted(), Freiburg1());
}

TEST(CameraModel, CheckNamesTheSourceOfWhatIsNoCamera) {
  EXPECT_NO_THROW(Freiburg1().Check("camera.yaml"));
  for (double CameraModel::*field : {&CameraModel::fx, &CameraModel::fy, &CameraModel::cx}) {
    CameraModel camera = Freiburg1();
    camera.*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT([&] { camera.Check("camera.yaml"); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("camera.yaml: intrinsics")));
  }
  CameraModel empty = Freiburg1();
  empty.width = 0;
  EXPECT_THAT([&] { empty.Check("camera.yaml"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("image size 0 x 480")));
}

}  // namespace
}  // namespace posefusion
