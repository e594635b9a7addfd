#include "posefusion/loop_closure/verification.h"

#include <gtest/gtest.h>

#include "test/loop_closure/mapped_room.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::MappedRoom;

Agreement Compare(MappedRoom& room, const Eigen::Isometry3d& T_map_camera,
                  const Eigen::Isometry3d& T_map_estimate) {
  const ModelView& view = room.View(T_map_estimate, 1);
  return CompareWithView(room.Frame(T_map_camera).levels[1], view,
                         view.T_map_camera.inverse() * T_map_estimate, room.noise());
}

TEST(Verification, TheTruePoseAgrees) {
  const Eigen::Isometry3d pose = LookAlong({-1, 0, 0.2}, 0.1, 0.2);
  MappedRoom room({pose});
  const Agreement agreement = Compare(room, pose, pose);
  EXPECT_GT(agreement.overlap, 0.9);
  EXPECT_GT(agreement.depth, 0.95);
  EXPECT_GT(agreement.intensity, 0.95);
}

TEST(Verification, AWrongPoseDoesNot) {
  const Eigen::Isometry3d pose = LookAlong({-1, 0, 0.2}, 0.1, 0.2);
  MappedRoom room({pose});
  const Agreement aside = Compare(room, pose, LookAlong({-1, 0.3, 0.2}, 0.1, 0.2));
  EXPECT_LT(aside.depth * aside.intensity, 0.6);
  const Agreement turned = Compare(room, pose, LookAlong({-1, 0, 0.2}, 0.3, 0.2));
  EXPECT_LT(turned.depth * turned.intensity, 0.6);
}

TEST(Verification, WhatTheMapDoesNotKnowSpeaksForNothing) {
  MappedRoom room({LookAlong({-1, 0, 0.2}, 0.1, 0.2)});
  const Eigen::Isometry3d aside = LookAlong({-1, 0, 0.2}, 0.5, 0.2);
  const Agreement half_known = Compare(room, aside, aside);
  EXPECT_LT(half_known.overlap, 0.8);
  EXPECT_GT(half_known.depth, 0.95);
  const Eigen::Isometry3d behind = LookAlong({-1, 0, 0.2}, 3.2, 0.2);
  const Agreement unknown = Compare(room, behind, behind);
  EXPECT_EQ(unknown.overlap, 0);
  EXPECT_EQ(unknown.depth, 0);
  EXPECT_EQ(unknown.intensity, 0);
}

}  // namespace
}  // namespace posefusion
