#include "posefusion/simulation/body.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posefusion {
namespace {

double LowestVertex(const std::array<TriangleMesh, kNumBodyParts>& parts, const PersonPose& pose) {
  double lowest = 10;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (const auto& vertex : parts[part].vertices) {
      lowest = std::min(lowest, (pose.T_map_part[part] * vertex.cast<double>()).z());
    }
  }
  return lowest;
}

TEST(Body, StandsOnTheFloorAsTallAsItIs) {
  const BodyShape shape(1.80);
  const PersonPose pose = PoseBody(shape, Posture{});
  const auto parts = BodyMeshes(shape, 0);
  double highest = 0;
  for (const auto& vertex : parts[kHead].vertices) {
    highest = std::max(highest, (pose.T_map_part[kHead] * vertex.cast<double>()).z());
  }
  EXPECT_NEAR(highest, 1.80, 0.06);
  EXPECT_NEAR(LowestVertex(parts, pose), 0.0, 0.03);
}

TEST(Body, KeepsItsSidesApart) {
  Posture posture;
  posture.yaw = 0.3;
  const PersonPose pose = PoseBody(BodyShape(1.7), posture);
  const Eigen::Vector3d left(-std::sin(0.3), std::cos(0.3), 0);
  for (const auto& [right_joint, left_joint] : {std::pair{kRightShoulder, kLeftShoulder},
                                                {kRightHip, kLeftHip},
                                                {kRightAnkle, kLeftAnkle},
                                                {kRightEye, kLeftEye},
                                                {kRightEar, kLeftEar}}) {
    EXPECT_GT((pose.joints[left_joint] - pose.joints[right_joint]).dot(left), 0.02);
  }
  const Eigen::Vector3d forward(std::cos(0.3), std::sin(0.3), 0);
  EXPECT_GT((pose.joints[kNose] - pose.joints[kLeftEar]).dot(forward), 0.05);
}

TEST(Body, BonesKeepTheirLengthInAnyPosture) {
  const BodyShape shape(1.75);
  Posture posture;
  posture.left = {1.4, 0.1, 1.5, 0.9, 0.3, 0.2, 1.2};
  posture.right = {-0.3, 0.0, 0.6, -0.5, 0.1, 0.0, 0.2};
  const PersonPose pose = PoseBody(shape, posture);
  const auto length = [&](CocoJoint a, CocoJoint b) {
    return (pose.joints[a] - pose.joints[b]).norm();
  };
  for (const bool left : {false, true}) {
    EXPECT_NEAR(length(left ? kLeftHip : kRightHip, left ? kLeftKnee : kRightKnee), shape.thigh,
                1e-9);
    EXPECT_NEAR(length(left ? kLeftElbow : kRightElbow, left ? kLeftWrist : kRightWrist),
                shape.forearm, 1e-9);
  }
}

TEST(Body, SitsAtTheHeightOfAChair) {
  Posture posture;
  for (LimbAngles* leg : {&posture.left, &posture.right}) leg->hip = leg->knee = 1.5;
  const PersonPose pose = PoseBody(BodyShape(1.72), posture);
  EXPECT_NEAR(pose.joints[kLeftHip].z(), 0.5, 0.06);
}

}  // namespace
}  // namespace posefusion
