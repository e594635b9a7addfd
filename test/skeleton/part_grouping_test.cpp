#include "posefusion/skeleton/part_grouping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "test/skeleton/painted_maps.h"

namespace posefusion {
namespace {

using testing::PaintedMaps;
using testing::StandingPerson;

constexpr float kPixel = 0.15F;  ///< what the parabola errs on a Gaussian, with neighbours' tails
constexpr float kConfidence = 0.2F;  ///< what a Gaussian loses half a pixel beside its maximum

const PartGroupingConfig kConfig;

/// Expects that each joint of `truth` was found where it is, and no other.
void ExpectSame(const Skeleton& found, const Skeleton& truth) {
  for (std::size_t j = 0; j < truth.size(); ++j) {
    EXPECT_EQ(found[j].p > 0, truth[j].p > 0) << "joint " << j;
    if (found[j].p <= 0 || truth[j].p <= 0) continue;
    EXPECT_NEAR(found[j].u, truth[j].u, kPixel) << "joint " << j;
    EXPECT_NEAR(found[j].v, truth[j].v, kPixel) << "joint " << j;
    EXPECT_NEAR(found[j].p, truth[j].p, kConfidence) << "joint " << j;
  }
}

Skeleton Without(Skeleton person, const std::set<int>& joints) {
  for (const int joint : joints) person[static_cast<std::size_t>(joint)] = {};
  return person;
}

TEST(PartGrouping, FindsOnePersonWithEveryJoint) {
  PaintedMaps maps;
  const Skeleton person = StandingPerson(20.3F, 4.6F, 0.9F);
  maps.Paint(person);
  const auto people = GroupParts(maps.maps(), kConfig);
  ASSERT_EQ(people.size(), 1U);
  ExpectSame(people[0], person);
}

TEST(PartGrouping, EmptyMapsHoldNobody) {
  EXPECT_TRUE(GroupParts(PaintedMaps().maps(), kConfig).empty());
}

TEST(PartGrouping, TellsTwoPeopleShoulderToShoulderApart) {
  PaintedMaps maps;
  const Skeleton left = StandingPerson(15, 4, 0.9F);
  const Skeleton right = StandingPerson(26, 5, 0.7F);
  maps.Paint(left);
  maps.Paint(right);
  const auto people = GroupParts(maps.maps(), kConfig);
  ASSERT_EQ(people.size(), 2U);
  ExpectSame(people[0], left);
  ExpectSame(people[1], right);
}

TEST(PartGrouping, MostCertainPersonComesFirstWhateverTheOrder) {
  const Skeleton sure = StandingPerson(30, 4, 0.9F);
  const Skeleton unsure = StandingPerson(12, 4, 0.5F);
  PaintedMaps sure_first;
  sure_first.Paint(sure);
  sure_first.Paint(unsure);
  PaintedMaps unsure_first;
  unsure_first.Paint(unsure);
  unsure_first.Paint(sure);
  for (const PaintedMaps* maps : {&sure_first, &unsure_first}) {
    const auto people = GroupParts(maps->maps(), kConfig);
    ASSERT_EQ(people.size(), 2U);
    ExpectSame(people[0], sure);
    ExpectSame(people[1], unsure);
  }
}

TEST(PartGrouping, MissingLimbsLeaveTheRestOfThePerson) {
  PaintedMaps maps;
  const Skeleton person =
      Without(StandingPerson(20, 4, 0.9F), {kRightElbow, kRightWrist, kLeftAnkle, kNose});
  maps.Paint(person);
  const auto people = GroupParts(maps.maps(), kConfig);
  ASSERT_EQ(people.size(), 1U);
  // Eyes and ears stay reachable: each shoulder has a limb to the ear of its side.
  ExpectSame(people[0], person);
}

TEST(PartGrouping, FieldAgainstTheLimbJoinsNothing) {
  PaintedMaps maps;
  maps.Paint(StandingPerson(20, 4, 0.9F));
  PartMaps turned = maps.maps();
  for (cv::Mat& field : turned.affinity) field = field * -1;
  EXPECT_TRUE(GroupParts(turned, kConfig).empty());
}

TEST(PartGrouping, FewerJointsThanAPersonNeedsAreNobody) {
  PaintedMaps maps;
  Skeleton arm{};
  arm[kRightShoulder] = {10, 10, 0.9F};
  arm[kRightElbow] = {10, 16, 0.9F};
  arm[kRightWrist] = {10, 22, 0.9F};
  maps.Paint(arm);
  PartGroupingConfig config;
  config.min_joints = 4;
  EXPECT_TRUE(GroupParts(maps.maps(), config).empty());
  config.min_joints = 3;
  const auto people = GroupParts(maps.maps(), config);
  ASSERT_EQ(people.size(), 1U);
  ExpectSame(people[0], arm);
}

TEST(PartGrouping, FaintPeopleAreLeftOutByTheirConfidence) {
  PaintedMaps maps;
  maps.Paint(StandingPerson(20, 4, 0.4F));
  PartGroupingConfig config;
  config.min_confidence = 0.5;
  EXPECT_TRUE(GroupParts(maps.maps(), config).empty());
  config.min_confidence = 0.3;
  EXPECT_EQ(GroupParts(maps.maps(), config).size(), 1U);
}

TEST(PartGrouping, KeepsTheMostCertainOfACrowd) {
  PaintedMaps maps(180, 140);
  for (int i = 0; i < 20; ++i) {
    maps.Paint(StandingPerson(10.0F + 18.0F * static_cast<float>(i % 10),
                              4.0F + 60.0F * static_cast<float>(i / 10),
                              0.4F + 0.02F * static_cast<float>(i)));
  }
  const auto people = GroupParts(maps.maps(), kConfig);
  ASSERT_EQ(people.size(), static_cast<std::size_t>(kMaxPeople));
  EXPECT_NEAR(people.front()[kNeck].p, 0.78F, kConfidence);
  EXPECT_GT(people.back()[kNeck].p, 0.48F);
}

TEST(PartGrouping, NotANumberIsNobody) {
  PaintedMaps maps;
  PartMaps bad = maps.maps();
  for (cv::Mat& heat : bad.heat) heat.setTo(std::numeric_limits<float>::quiet_NaN());
  for (cv::Mat& field : bad.affinity) field.setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(GroupParts(bad, kConfig).empty());
}

}  // namespace
}  // namespace posefusion
