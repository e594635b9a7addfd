#include "posefusion/loop_closure/fern_encoder.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "test/support/rendered_room.h"

namespace posefusion {
namespace {

using testing::LookAlong;

/// Codes of rendered frames, 80x60 behind 160x120.
class FernEncoderTest : public ::testing::Test {
 protected:
  static FernConfig SmallImages() {
    FernConfig config;
    config.level = 1;
    return config;
  }

  FernCode Encode(RgbdFrame frame, const cv::Mat& mask = cv::Mat(),
                  const FernConfig& config = SmallImages()) {
    FramePyramid pyramid;
    PyramidBuilder(PyramidConfig(), DepthNoiseConfig())
        .Build(frame, {mask, {}}, parallel_, pyramid);
    FernCode code;
    FernEncoder(config, PyramidConfig()).Encode(pyramid, code);
    return code;
  }

  RgbdFrame Frame(double x_m = -1, double yaw_rad = 0.1) const {
    return room_.Render(testing::SmallCamera(), LookAlong({x_m, 0, 0.2}, yaw_rad, 0.2), 1);
  }

  static double Similarity(const FernCode& a, const FernCode& b) {
    return CompareFerns(a.data(), b.data(), static_cast<int>(a.size())).Similarity();
  }

  ParallelRunner parallel_{2};
  testing::RenderedRoom room_ = testing::RenderedRoom::Furnished();
};

TEST_F(FernEncoderTest, GivesTheSameCodeForTheSameFrame) {
  const FernCode code = Encode(Frame());
  EXPECT_EQ(code.size(), 500U);
  EXPECT_EQ(code, Encode(Frame()));
  EXPECT_GT(KnownShare(code), 0.9);
}

TEST_F(FernEncoderTest, AnotherSeedIsAnotherCode) {
  FernConfig config = SmallImages();
  config.seed = 2;
  EXPECT_LT(Similarity(Encode(Frame()), Encode(Frame(), cv::Mat(), config)), 0.5);
}

TEST_F(FernEncoderTest, NearViewsAreMoreAlikeThanFarOnes) {
  const FernCode code = Encode(Frame());
  const double near = Similarity(code, Encode(Frame(-0.97, 0.12)));
  const double farther = Similarity(code, Encode(Frame(-0.7, 0.4)));
  const double opposite = Similarity(code, Encode(Frame(-1, 3.2)));
  EXPECT_GT(near, 0.8);
  EXPECT_GT(near, farther);
  EXPECT_GT(farther, opposite);
  EXPECT_LT(opposite, 0.5);
}

TEST_F(FernEncoderTest, PeopleAreUnknownAndChangeNothingElse) {
  const FernCode empty_room = Encode(Frame());
  RgbdFrame with_person = Frame();
  cv::Mat mask(with_person.rgb.size(), CV_8UC1, cv::Scalar::all(0));
  const cv::Rect person(40, 0, 60, 120);
  mask(person).setTo(255);
  with_person.rgb(person).setTo(cv::Scalar(200, 10, 90));
  const FernCode code = Encode(with_person, mask);
  EXPECT_NEAR(KnownShare(code), KnownShare(empty_room) * 100.0 / 160, 0.08);
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] != kUnknownFern) {
      EXPECT_EQ(code[i], empty_room[i]) << i;
    }
  }
}

TEST_F(FernEncoderTest, PixelsWithoutDepthAreUnknown) {
  RgbdFrame frame = Frame();
  frame.depth_m.setTo(0);
  EXPECT_EQ(KnownShare(Encode(frame)), 0);
}

TEST_F(FernEncoderTest, ImagesSmallerThanTheFernsLevelDoNoHarm) {
  RgbdFrame frame = Frame();
  const cv::Rect corner(0, 0, 12, 12);
  frame.rgb = frame.rgb(corner).clone();
  frame.depth_m = frame.depth_m(corner).clone();
  frame.camera.width = frame.camera.height = 12;
  FernConfig config;
  config.level = 3;
  EXPECT_EQ(Encode(frame, cv::Mat(), config).size(), 500U);
}

}  // namespace
}  // namespace posefusion
