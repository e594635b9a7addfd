#include "posefusion/skeleton/skeleton_checks.h"

#include <gtest/gtest.h>

#include <limits>

#include "test/skeleton/sample_skeletons.h"

namespace posefusion {
namespace {

TEST(UsableJoint, NumbersThatAreNotFiniteAreNotFound) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_EQ(UsableJoint(bad, 1, 0.5).p, 0);
    EXPECT_EQ(UsableJoint(1, bad, 0.5).p, 0);
    EXPECT_EQ(UsableJoint(1, 1, bad).p, 0);
    EXPECT_EQ(UsableJoint(bad, 1, 0.5).v, 0) << "all zeros";
  }
}

TEST(DropUnusable, KeepsJointsWhosePixelExists) {
  Skeleton person{};
  person[kNose] = {-0.4F, 0, 1};
  person[kNeck] = {639.4F, 479.4F, 1};
  person[kLeftHip] = {-0.6F, 10, 1};
  person[kRightHip] = {639.6F, 10, 1};
  person[kLeftKnee] = {10, 479.6F, 1};
  std::vector<Skeleton> people = {person};
  DropUnusable(people, 640, 480);
  EXPECT_EQ(people[0][kNose].p, 1);
  EXPECT_EQ(people[0][kNeck].p, 1);
  for (const CocoJoint outside : {kLeftHip, kRightHip, kLeftKnee}) {
    EXPECT_EQ(people[0][outside].p, 0) << outside;
    EXPECT_EQ(people[0][outside].u, 0) << outside;
  }
}

TEST(DropUnusable, PeopleWithoutJointsGo) {
  std::vector<Skeleton> people = {testing::PersonAt(5000, 0), testing::PersonAt(50, 60),
                                  Skeleton{}};
  DropUnusable(people, 640, 480);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0][0].u, 50);
}

}  // namespace
}  // namespace posefusion
