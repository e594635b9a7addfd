#include "posefusion/loop_closure/fern_database.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace posefusion {
namespace {

constexpr int kFerns = 200;

FernConfig Config() {
  FernConfig config;
  config.num_ferns = kFerns;
  config.max_similarity = 0.7;
  config.min_known_share = 0.3;
  return config;
}

FernCode RandomCode(std::uint32_t seed) {
  std::mt19937 random(seed);
  FernCode code(kFerns);
  for (auto& fern : code) fern = static_cast<std::uint8_t>(random() % 16);
  return code;
}

/// `code` with the first `count` ferns changed.
FernCode Changed(FernCode code, int count) {
  for (int i = 0; i < count; ++i) code[static_cast<std::size_t>(i)] ^= 1;
  return code;
}

/// `code` with the last `count` ferns not known.
FernCode Hidden(FernCode code, int count) {
  std::fill(code.end() - count, code.end(), kUnknownFern);
  return code;
}

const Eigen::Isometry3d kPose = Eigen::Isometry3d::Identity();

TEST(FernDatabase, SimilarityIsTheShareOfEqualFernsAmongThoseKnownInBoth) {
  FernDatabase database(Config());
  ASSERT_TRUE(database.AddIfNew(1, Hidden(RandomCode(1), 40), kPose));
  const auto similarity = [&](const FernCode& code) {
    return database.Query(code, 1, 0).at(0).similarity;
  };
  EXPECT_EQ(similarity(RandomCode(1)), 1);
  EXPECT_EQ(similarity(Changed(RandomCode(1), 16)), 144.0 / 160);
  EXPECT_EQ(similarity(Changed(RandomCode(1), kFerns)), 0);
}

TEST(FernDatabase, StoresOnlyWhatIsNew) {
  FernDatabase database(Config());
  EXPECT_TRUE(database.AddIfNew(1, RandomCode(1), kPose));
  EXPECT_FALSE(database.AddIfNew(2, RandomCode(1), kPose));
  EXPECT_FALSE(database.AddIfNew(3, Changed(RandomCode(1), 50), kPose));
  EXPECT_TRUE(database.AddIfNew(4, Changed(RandomCode(1), 70), kPose));
  EXPECT_TRUE(database.AddIfNew(5, RandomCode(2), kPose));
  EXPECT_FALSE(database.AddIfNew(6, RandomCode(1), kPose));
  EXPECT_EQ(database.size(), 3);
}

TEST(FernDatabase, CodesOfWhichTooLittleIsKnownAreNeitherStoredNorFound) {
  FernDatabase database(Config());
  EXPECT_FALSE(database.AddIfNew(1, Hidden(RandomCode(1), 150), kPose));
  ASSERT_TRUE(database.AddIfNew(2, RandomCode(1), kPose));
  EXPECT_TRUE(database.Query(Hidden(RandomCode(1), 150), 5, 0).empty());
  EXPECT_EQ(database.Query(Hidden(RandomCode(1), 130), 5, 0).size(), 1U);
}

TEST(FernDatabase, CodesKnownInDifferentPartsAreNotCompared) {
  FernDatabase database(Config());
  FernCode reversed = Hidden(RandomCode(1), 100);
  std::reverse(reversed.begin(), reversed.end());
  ASSERT_TRUE(database.AddIfNew(1, reversed, kPose));
  EXPECT_TRUE(database.Query(Hidden(RandomCode(1), 100), 5, 0).empty());
}

TEST(FernDatabase, GivesTheMostSimilarFirst) {
  FernDatabase database(Config());
  const FernCode code = RandomCode(1);
  for (const int changes : {200, 70, 135}) {
    Eigen::Isometry3d T_map_camera = kPose;
    T_map_camera.translation().x() = changes;
    ASSERT_TRUE(database.AddIfNew(changes, Changed(code, changes), T_map_camera));
  }
  const std::vector<FernMatch> matches = database.Query(code, 2, 0.2);
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[0].keyframe.id, 1);
  EXPECT_EQ(matches[0].keyframe.stamp_ns, 70);
  EXPECT_EQ(matches[0].keyframe.T_map_camera.translation().x(), 70);
  EXPECT_EQ(matches[1].keyframe.id, 2);
  EXPECT_EQ(database.Query(code, 3, 0.2).size(), 2U);  // the third is not similar enough
}

TEST(FernDatabase, ForgetsTheMostSimilarViewWhenFull) {
  FernConfig config = Config();
  config.max_keyframes = 3;
  FernDatabase database(config);
  for (std::uint32_t i = 1; i <= 3; ++i) ASSERT_TRUE(database.AddIfNew(i, RandomCode(i), kPose));
  ASSERT_TRUE(database.AddIfNew(9, Changed(RandomCode(2), 80), kPose));
  EXPECT_EQ(database.size(), 3);
  EXPECT_EQ(database.Query(RandomCode(1), 1, 0.9).size(), 1U);
  EXPECT_EQ(database.Query(RandomCode(2), 1, 0.9).size(), 0U);
  EXPECT_EQ(database.Query(RandomCode(3), 1, 0.9).size(), 1U);
  EXPECT_EQ(database.Query(RandomCode(2), 1, 0.5).at(0).keyframe.id, 3);
}

}  // namespace
}  // namespace posefusion
