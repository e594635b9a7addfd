#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "posefusion/skeleton/joints.h"

namespace posefusion {

/// Rigid parts of a body, each with a mesh of its own.
enum BodyPart {
  kPelvis,
  kChest,
  kNeckPart,
  kHead,
  kRightUpperArm,
  kRightForearm,
  kRightHand,
  kLeftUpperArm,
  kLeftForearm,
  kLeftHand,
  kRightThigh,
  kRightShank,
  kRightFoot,
  kLeftThigh,
  kLeftShank,
  kLeftFoot,
  kNumBodyParts
};

/// A line with a radius that a body part lies in, for distances and for where people were. Map
/// frame, metres.
struct Capsule {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double radius_m;
};

/// Where a person is at one time. Map frame.
struct PersonPose {
  bool present =
      false;  ///< false while the person is out of the building; nothing else is set then
  std::array<Eigen::Vector3d, kNumCocoJoints> joints;  ///< true joints, inside the body
  std::array<Eigen::Isometry3d, kNumBodyParts> T_map_part;
  std::array<Capsule, kNumBodyParts> capsules;
};

}  // namespace posefusion
