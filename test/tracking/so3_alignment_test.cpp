#include "posefusion/tracking/so3_alignment.h"

#include <gtest/gtest.h>

#include "posefusion/common/lie.h"
#include "test/support/rendered_room.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::RenderedRoom;

Grid<float> Intensity(const RgbdFrame& frame) {
  Grid<float> grey(frame.camera.width, frame.camera.height);
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) {
      const cv::Vec3b rgb = frame.rgb.at<cv::Vec3b>(y, x);
      grey.at(x, y) = 0.299F * static_cast<float>(rgb[0]) + 0.587F * static_cast<float>(rgb[1]) +
                      0.114F * static_cast<float>(rgb[2]);
    }
  }
  return grey;
}

TEST(So3Alignment, RecoversAPureRotation) {
  const CameraModel camera = testing::SmallCamera();
  const RenderedRoom room = RenderedRoom::Furnished();
  const Eigen::Isometry3d reference = LookAlong({-1, 0, 0.2}, 0.2, 0.3);
  for (const Eigen::Vector3d& omega :
       {Eigen::Vector3d(0.04, 0, 0), Eigen::Vector3d(0, -0.06, 0), Eigen::Vector3d(0, 0, 0.1),
        Eigen::Vector3d(0.03, 0.04, -0.05)}) {
    Eigen::Isometry3d current = reference;
    current.linear() = reference.linear() * ExpSO3(omega);
    const Eigen::Matrix3d R =
        AlignRotation(Intensity(room.Render(camera, reference, 0)),
                      Intensity(room.Render(camera, current, 0)), camera, So3Config());
    EXPECT_LT((LogSO3(R) - omega).norm(), 0.003) << omega.transpose();
  }
}

TEST(So3Alignment, WithoutTextureThereIsNoRotation) {
  const CameraModel camera = testing::SmallCamera();
  const Grid<float> grey = [&] {
    Grid<float> image(camera.width, camera.height);
    image.Fill(100);
    return image;
  }();
  EXPECT_LT(LogSO3(AlignRotation(grey, grey, camera, So3Config())).norm(), 1e-3);
}

TEST(So3Alignment, MaskedImagesGiveIdentity) {
  const CameraModel camera = testing::SmallCamera();
  Grid<float> masked(camera.width, camera.height);
  masked.Fill(-1);
  EXPECT_TRUE(AlignRotation(masked, masked, camera, So3Config()).isIdentity());
}

}  // namespace
}  // namespace posefusion
