#include "posefusion/segmentation/boosted_trees.h"

#include <gtest/gtest.h>

#include "posefusion/segmentation/cell_features.h"

namespace posefusion {
namespace {

constexpr float kNoLimit = 1e9F;

/// Feature 0 up to 1: -2, else feature 1 up to 3: 4, else 8.
std::vector<TreeNode> OneTree() {
  return {{0, 1, 2, 1.0F}, {-1, 0, 0, -2.0F}, {1, 1, 2, 3.0F}, {-1, 0, 0, 4.0F}, {-1, 0, 0, 8.0F}};
}

float Sum(const BoostedTrees& trees, float first, float second, float limit = kNoLimit) {
  const float features[] = {first, second};
  return trees.Evaluate(features, limit);
}

TEST(BoostedTrees, AddsTheLeafThatTheFeaturesLeadTo) {
  const BoostedTrees trees(OneTree(), {0}, 0.5F);
  EXPECT_EQ(Sum(trees, 1, 0), -1.5F);
  EXPECT_EQ(Sum(trees, 2, 3), 4.5F);
  EXPECT_EQ(Sum(trees, 2, 3.1F), 8.5F);
}

TEST(BoostedTrees, LooksAtNoMoreTreesOnceTheSumIsBeyondTheLimit) {
  const BoostedTrees trees(OneTree(), std::vector<int>(100, 0), 0);
  EXPECT_EQ(Sum(trees, 2, 4), 800);
  EXPECT_LT(Sum(trees, 2, 4, 20), 800);
  EXPECT_GT(Sum(trees, 2, 4, 20), 20);
}

/// A cell of a standing person two metres away.
CellFeatures CellBesideSeed(float distance_m, float colour_ratio) {
  CellFeatures features{};
  features[kSeedDistance] = features[kSeedDistanceShared] = features[kThickDistance] = distance_m;
  features[kMediumDistance] = features[kThinDistance] = distance_m + 0.3F;
  features[kCellDepth] = 2;
  features[kInUnseenPart] = -1;
  features[kColourRatio] = colour_ratio;
  features[kPieceArea] = -0.7F;
  features[kNumJoints] = 14;
  features[kNumCertainJoints] = 14;
  features[kHasKnee] = features[kHasAnkle] = features[kHasWrists] = features[kHasHip] = 1;
  return features;
}

TEST(PersonTrees, TellPersonFromBackground) {
  const auto odds = [](const CellFeatures& f) {
    return PersonTrees().Evaluate(f.data(), kNoLimit);
  };
  EXPECT_GT(odds(CellBesideSeed(0.03F, 0)), 1);
  EXPECT_LT(odds(CellBesideSeed(0.8F, 0)), -2);
  EXPECT_GT(odds(CellBesideSeed(0.2F, 3)), odds(CellBesideSeed(0.2F, -3)) + 2);
  CellFeatures on_plane = CellBesideSeed(0.15F, 0);
  on_plane[kOnSurface] = 1;
  on_plane[kPieceArea] = -10;
  EXPECT_LT(odds(on_plane), odds(CellBesideSeed(0.15F, 0)));
}

}  // namespace
}  // namespace posefusion
