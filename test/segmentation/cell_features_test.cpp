#include "posefusion/segmentation/cell_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

/// A slab of a person before a wall.
class CellFeaturesTest : public testing::Test {
 protected:
  CellFeaturesTest() {
    const RgbdFrame frame = scene_.Render();
    cells_.Build(frame.depth_m, frame.camera);
    surfaces_.Resize(cells_.width(), cells_.height());
    surfaces_.Fill(0);
    colours_ = cv::Mat(cells_.size(), CV_8UC3, cv::Scalar::all(90));
    people_ = {LiftPerson(scene_.Joints(), frame, SeedConfig())};
  }

  bool Read(double x_m, double y_m, double z_m) {
    const CellScene scene{cells_, colours_, surfaces_, people_, nullptr};
    CellFeatureReader reader;
    reader.Open(scene);
    const Eigen::Vector2d place = cells_.PlaceOf({x_m, y_m, z_m});
    return reader.Read(
        {static_cast<int>(std::lround(place.x())), static_cast<int>(std::lround(place.y()))},
        features_);
  }

  SyntheticScene scene_;
  CellGrid cells_{CellGridConfig()};
  Grid<std::uint8_t> surfaces_;
  cv::Mat colours_;
  std::vector<PersonSeeds> people_;
  CellFeatures features_{};
};

TEST_F(CellFeaturesTest, ACellOfTheTrunkIsNearItsSeeds) {
  ASSERT_TRUE(Read(0, 0.05, scene_.person_m));
  EXPECT_LT(features_[kSeedDistance], 0.15F);
  EXPECT_NEAR(features_[kCellDepth], scene_.person_m, 0.01);
  EXPECT_NEAR(features_[kBehindSeed], 0, 0.01);
  EXPECT_NEAR(features_[kBehindBody], 0, 0.01);
  EXPECT_EQ(features_[kOnSurface], 0);
  EXPECT_EQ(features_[kNumJoints], 12) << "the ankles are below the image";
  EXPECT_EQ(features_[kNumCertainJoints], 12);
  EXPECT_EQ(features_[kHasAnkle], 0);
  EXPECT_EQ(features_[kHasKnee] + features_[kHasWrists] + features_[kHasHip], 3);
}

TEST_F(CellFeaturesTest, ThePieceIsAsLargeAsTheSlab) {
  ASSERT_TRUE(Read(0, 0, scene_.person_m));
  const double height = std::min(scene_.floor_m, 239.5 / 525 * scene_.person_m) - scene_.top_m;
  EXPECT_NEAR(std::exp(features_[kPieceArea]), 2 * scene_.half_width_m * height, 0.1);
}

TEST_F(CellFeaturesTest, TheWallBehindIsOutOfReach) { EXPECT_FALSE(Read(0.5, 0, scene_.wall_m)); }

TEST_F(CellFeaturesTest, SeedsOnSurfacesDoNotCount) {
  surfaces_.Fill(1);
  EXPECT_FALSE(Read(0, 0, scene_.person_m));
}

TEST_F(CellFeaturesTest, NothingIsReadWithoutDepth) {
  cells_.Build(cv::Mat::zeros(480, 640, CV_32FC1), scene_.camera);
  EXPECT_FALSE(Read(0, 0, scene_.person_m));
}

TEST_F(CellFeaturesTest, KnowsWhereAnUnseenPartMayBe) {
  people_[0].unseen_parts = {{{0.1F, 0, 2}, 0.3F, true}};
  ASSERT_TRUE(Read(0.1, 0, scene_.person_m));
  EXPECT_NEAR(features_[kInUnseenPart], 0.3F, 0.02F);
  EXPECT_EQ(features_[kLeavesImage], 1);
}

}  // namespace
}  // namespace posefusion
