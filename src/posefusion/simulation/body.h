#pragma once

#include <array>

#include "posefusion/dataset/triangle_mesh.h"
#include "posefusion/simulation/person.h"

namespace posefusion {

/// Lengths of a body in metres. Shares of the body height: Drillis & Contini, "Body segment
/// parameters", 1966, as in Winter, "Biomechanics and Motor Control of Human Movement", fig. 4.1.
struct BodyShape {
  explicit BodyShape(double height_m = 1.72, double girth = 1.0)
      : height(height_m),
        girth(girth),
        thigh(0.245 * height_m),
        shank(0.246 * height_m),
        foot_height(0.039 * height_m),
        foot_length(0.152 * height_m),
        hip_half(0.052 * height_m),
        trunk(0.288 * height_m),
        shoulder_half(0.118 * height_m),
        upper_arm(0.186 * height_m),
        forearm(0.146 * height_m),
        hand(0.108 * height_m),
        neck(0.060 * height_m),
        head(0.122 * height_m) {}
  double height, girth;
  double thigh, shank, foot_height, foot_length, hip_half;
  double trunk;  ///< hips to shoulders
  double shoulder_half, upper_arm, forearm, hand;
  double neck;  ///< shoulders to the head's lower end
  double head;  ///< lower end to crown
};

/// Angles in radians, 0 = standing upright with hanging arms. Flexion turns forward.
struct LimbAngles {
  double hip = 0, hip_out = 0, knee = 0;
  double shoulder = 0, shoulder_out = 0, shoulder_in = 0, elbow = 0;
};

struct Posture {
  Eigen::Vector2d floor = Eigen::Vector2d::Zero();  ///< below the middle of the hips, map
  double yaw = 0;                                   ///< facing, in the map
  double lean = 0;                                  ///< of the trunk, forward
  double sway = 0;                                  ///< of the trunk, to the left
  double twist = 0;                                 ///< of the chest against the hips
  double head_yaw = 0, head_pitch = 0;
  LimbAngles right, left;
};

/// a + (b - a) * share, angle by angle; yaw turns the short way.
Posture Blend(const Posture& a, const Posture& b, double share);

/// Forward kinematics. The hips are as high as the longer leg needs to stand on the floor.
PersonPose PoseBody(const BodyShape& shape, const Posture& posture);

/// Meshes of all parts in their own frames: origin at the joint towards the trunk, x forward,
/// z up along the bone. `person` chooses the materials.
std::array<TriangleMesh, kNumBodyParts> BodyMeshes(const BodyShape& shape, int person);

}  // namespace posefusion
