#pragma once

#include <array>

namespace posefusion {

/// Joints in OpenPose's COCO-18 order.
enum CocoJoint {
  kNose,
  kNeck,
  kRightShoulder,
  kRightElbow,
  kRightWrist,
  kLeftShoulder,
  kLeftElbow,
  kLeftWrist,
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kRightEye,
  kLeftEye,
  kRightEar,
  kLeftEar,
  kNumCocoJoints
};

/// Two joints with body between them.
struct Bone {
  CocoJoint from;
  CocoJoint to;
};

/// The limbs of OpenPose's COCO model, and the sides of the trunk.
constexpr std::array<Bone, 19> kBones = {{{kNeck, kRightShoulder},
                                          {kNeck, kLeftShoulder},
                                          {kRightShoulder, kRightElbow},
                                          {kRightElbow, kRightWrist},
                                          {kLeftShoulder, kLeftElbow},
                                          {kLeftElbow, kLeftWrist},
                                          {kNeck, kRightHip},
                                          {kRightHip, kRightKnee},
                                          {kRightKnee, kRightAnkle},
                                          {kNeck, kLeftHip},
                                          {kLeftHip, kLeftKnee},
                                          {kLeftKnee, kLeftAnkle},
                                          {kNeck, kNose},
                                          {kNose, kRightEye},
                                          {kRightEye, kRightEar},
                                          {kNose, kLeftEye},
                                          {kLeftEye, kLeftEar},
                                          {kRightShoulder, kRightHip},
                                          {kLeftShoulder, kLeftHip}}};

}  // namespace posefusion
