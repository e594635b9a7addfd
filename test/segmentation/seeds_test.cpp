#include "posefusion/segmentation/seeds.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

constexpr float kMillimetre = 0.001F;
constexpr int kJointsInView = 12;  ///< of 14; the ankles are below the image

SeedConfig JointsOnly() {
  SeedConfig config;
  config.seed_along_bones = false;
  config.seed_extremities = false;
  return config;
}

TEST(LiftPerson, PutsJointsWhereTheyAre) {
  SyntheticScene scene;
  scene.person_x_m = 0.4;
  const PersonSeeds person = LiftPerson(scene.Joints(), scene.Render(), JointsOnly());
  ASSERT_EQ(person.num_joints, kJointsInView);
  EXPECT_NEAR(person.body_depth_m, 2.0F, kMillimetre);
  EXPECT_LT((person.seeds[1].p_camera - Eigen::Vector3f(0.4F, -0.2F, 2)).norm(), kMillimetre);
}

TEST(LiftPerson, TakesLensDistortionOut) {
  SyntheticScene scene;
  scene.camera = DistortedCamera();
  scene.person_x_m = 0.9;
  const PersonSeeds person = LiftPerson(scene.Joints(), scene.Render(), JointsOnly());
  ASSERT_EQ(person.num_joints, kJointsInView);
  EXPECT_LT((person.seeds[1].p_camera - Eigen::Vector3f(0.9F, -0.2F, 2)).norm(), kMillimetre);
}

TEST(LiftPerson, TakesThePersonsSideOfADepthEdge) {
  const SyntheticScene scene;
  Skeleton joints = scene.Joints();
  joints[kRightElbow] = scene.JointAt(-scene.half_width_m - 0.005, 0.08);  // 1 px beside the slab
  const PersonSeeds person = LiftPerson(joints, scene.Render(), JointsOnly());
  ASSERT_TRUE(person.found[kRightElbow]);
  EXPECT_NEAR(person.seeds[kRightElbow].p_camera.z(), 2.0F, kMillimetre);
}

TEST(LiftPerson, DropsAJointOnTheWallBehind) {
  const SyntheticScene scene;
  Skeleton joints = scene.Joints();
  joints[kRightElbow] = scene.JointAt(-0.5, 0.08);
  EXPECT_FALSE(LiftPerson(joints, scene.Render(), JointsOnly()).found[kRightElbow]);
}

TEST(LiftPerson, DropsAJointBehindATable) {
  const SyntheticScene scene;
  RgbdFrame frame = scene.Render();
  frame.depth_m.rowRange(330, 480).setTo(1.2F);
  const PersonSeeds person = LiftPerson(scene.Joints(), frame, JointsOnly());
  EXPECT_FALSE(person.found[kRightKnee]);
  EXPECT_TRUE(person.found[kRightElbow]);
}

TEST(LiftPerson, DropsAnUncertainJointThatIsNearerThanTheBody) {
  const SyntheticScene scene;
  RgbdFrame frame = scene.Render();
  frame.depth_m.rowRange(330, 480).setTo(1.6F);
  Skeleton joints = scene.Joints();
  EXPECT_TRUE(LiftPerson(joints, frame, JointsOnly()).found[kRightKnee]);
  joints[kRightKnee].p = 0.2F;
  EXPECT_FALSE(LiftPerson(joints, frame, JointsOnly()).found[kRightKnee]);
}

/// A camera that looks down on somebody: the feet are more than a metre farther than the head.
TEST(LiftPerson, FollowsABodyAwayFromTheCamera) {
  const SyntheticScene scene;
  RgbdFrame frame = scene.Render();
  for (int v = 0; v < frame.depth_m.rows; ++v) {
    frame.depth_m.row(v).setTo(0.9F + 1.6F * static_cast<float>(v) / 479);
  }
  Skeleton joints{};
  joints[kNose] = {320, 60, 0.8F};
  joints[kNeck] = {320, 120, 0.8F};
  joints[kRightHip] = {310, 250, 0.8F};
  joints[kRightKnee] = {310, 350, 0.8F};
  joints[kRightAnkle] = {310, 430, 0.8F};
  const PersonSeeds person = LiftPerson(joints, frame, JointsOnly());
  EXPECT_EQ(person.num_joints, 5);
  joints[kRightAnkle].p = 0.2F;  // hidden, most likely
  EXPECT_FALSE(LiftPerson(joints, frame, JointsOnly()).found[kRightAnkle]);
}

TEST(LiftPerson, DropsJointsWithoutDepthAndWithLittleConfidence) {
  const SyntheticScene scene;
  RgbdFrame frame = scene.Render();
  Skeleton joints = scene.Joints();
  joints[kLeftKnee].p = 0.05F;
  const Joint hip = joints[kLeftHip];
  frame.depth_m(cv::Rect(static_cast<int>(hip.u) - 6, static_cast<int>(hip.v) - 6, 13, 13))
      .setTo(0);
  const PersonSeeds person = LiftPerson(joints, frame, JointsOnly());
  EXPECT_FALSE(person.found[kLeftHip]);
  EXPECT_FALSE(person.found[kLeftKnee]);
  EXPECT_TRUE(person.found[kRightKnee]);
}

TEST(LiftPerson, DropsAJointFartherThanABoneIsLong) {
  SyntheticScene scene;
  Skeleton joints = scene.Joints();
  scene.half_width_m = 1.4;  // something as near as the person beside it
  joints[kRightWrist] = scene.JointAt(-1.2, 0.3);
  EXPECT_FALSE(LiftPerson(joints, scene.Render(), JointsOnly()).found[kRightWrist]);
}

TEST(LiftPerson, SeedsBonesOnThePersonOnly) {
  const SyntheticScene scene;
  RgbdFrame frame = scene.Render();
  SeedConfig config = JointsOnly();
  config.seed_along_bones = true;
  const PersonSeeds person = LiftPerson(scene.Joints(), frame, config);
  EXPECT_GT(person.seeds.size(), 60U);
  for (const Seed& seed : person.seeds) EXPECT_NEAR(seed.p_camera.z(), 2.0F, kMillimetre);
}

TEST(LiftPerson, KnowsThatLimbsAreThinnerThanTheTrunk) {
  const SyntheticScene scene;
  const SeedConfig config = JointsOnly();
  const PersonSeeds person = LiftPerson(scene.Joints(), scene.Render(), config);
  ASSERT_EQ(person.num_joints, kJointsInView);
  EXPECT_EQ(person.seeds[kNeck].radius_share, 1);
  EXPECT_FLOAT_EQ(person.seeds[kRightWrist].radius_share,
                  static_cast<float>(config.arm_radius_share));
  EXPECT_FLOAT_EQ(person.seeds[kRightKnee].radius_share,
                  static_cast<float>(config.leg_radius_share));
}

TEST(LiftPerson, LetsLimbsLeaveTheImageAtItsBorderOnly) {
  const auto leaves = [](double person_x_m) {
    SyntheticScene scene;
    scene.person_x_m = person_x_m;
    Skeleton joints = scene.Joints();
    joints[kRightWrist] = joints[kLeftWrist] = Joint();
    const PersonSeeds person = LiftPerson(joints, scene.Render(), JointsOnly());
    EXPECT_FALSE(person.unseen_parts.empty());
    return std::any_of(person.unseen_parts.begin(), person.unseen_parts.end(),
                       [](const UnseenPart& part) { return part.leaves_image; });
  };
  EXPECT_FALSE(leaves(0));
  EXPECT_TRUE(leaves(0.9));
}

/// Joints down to the hips.
Skeleton WithoutLegs(const SyntheticScene& scene) {
  Skeleton joints = scene.Joints();
  for (const CocoJoint joint : {kRightKnee, kLeftKnee, kRightAnkle, kLeftAnkle}) joints[joint] = {};
  return joints;
}

bool MayBeAt(const PersonSeeds& person, const Eigen::Vector3f& p_camera) {
  return std::any_of(
      person.unseen_parts.begin(), person.unseen_parts.end(),
      [&](const UnseenPart& part) { return (part.p_camera - p_camera).norm() < part.radius_m; });
}

TEST(LiftPerson, LooksForMissingLegsDownTheImageWhereGravityIsUnknown) {
  const SyntheticScene scene;
  const PersonSeeds person = LiftPerson(WithoutLegs(scene), scene.Render(), SeedConfig());
  EXPECT_TRUE(MayBeAt(person, {0, 1, 2}));
  EXPECT_FALSE(MayBeAt(person, {1, 0, 2}));
}

TEST(LiftPerson, LooksForMissingLegsAlongGravity) {
  const SyntheticScene scene;
  const Skeleton joints = Rolled(WithoutLegs(scene), scene.camera);
  const Eigen::Vector3f gravity = Eigen::Vector3f::UnitX();
  const PersonSeeds person = LiftPerson(joints, Rolled(scene.Render()), SeedConfig(), gravity);
  ASSERT_TRUE(person.found[kRightHip]);
  EXPECT_TRUE(MayBeAt(person, {0.7F, 0, 2})) << "knees";
  EXPECT_TRUE(MayBeAt(person, {1.08F, 0, 2})) << "ankles";
  EXPECT_FALSE(MayBeAt(person, {0, 0.7F, 2}));
}

TEST(LiftPerson, GivesNothingWithoutDepth) {
  const SyntheticScene scene;
  RgbdFrame frame = scene.Render();
  frame.depth_m.setTo(0);
  EXPECT_TRUE(LiftPerson(scene.Joints(), frame, SeedConfig()).seeds.empty());
}

TEST(LiftPerson, EnduresJointsThatAreNoNumbersOrFarOutside) {
  const SyntheticScene scene;
  Skeleton joints = scene.Joints();
  joints[kNose] = {std::nanf(""), 5, 0.9F};
  joints[kNeck] = {1e30F, -1e30F, 0.9F};
  const PersonSeeds person = LiftPerson(joints, scene.Render(), SeedConfig());
  EXPECT_FALSE(person.found[kNose]);
  EXPECT_FALSE(person.found[kNeck]);
  EXPECT_TRUE(person.found[kRightHip]);
}

}  // namespace
}  // namespace posefusion
