#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/segmentation/seed_distance.h"
#include "posefusion/segmentation/unseen_part.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

struct SeedConfig {
  double min_joint_confidence = 0.1;  ///< joints less certain do not seed
  int window_px = 4;                  ///< depth of a joint is looked for so far around it
  double layer_gap_m = 0.1;           ///< depths this far apart are of different surfaces
  double max_body_depth_m = 0.6;      ///< a joint lies this close in depth to the body
  double max_bone_stretch = 1.25;     ///< bones are at most so much longer than a tall person's
  bool seed_along_bones = true;       ///< besides joints, points between them
  double bone_step_m = 0.05;          ///< distance between points on a bone
  double bone_depth_m = 0.15;         ///< a point lies this close in depth to the line of its bone
  bool seed_extremities = true;       ///< hands, feet and the top of the head, beyond the joints
  double arm_radius_share = 0.56;     ///< elbows and wrists: of r of equation 3 and of the distance
                                      ///< of large planes (own extension)
  double leg_radius_share = 0.7;      ///< hips, knees and ankles: the same
  double min_depth_m = 0.3;           ///< nearer depth is none
  double max_depth_m = 8.0;           ///< farther depth is none
};

template <class V>
void Describe(V& v, SeedConfig& c) {
  v.Field("min_joint_confidence", c.min_joint_confidence, 0.0, 1.0);
  v.Field("window_px", c.window_px, 0, 20);
  v.Field("layer_gap_m", c.layer_gap_m, 0.01, 1.0);
  v.Field("max_body_depth_m", c.max_body_depth_m, 0.1, 3.0);
  v.Field("max_bone_stretch", c.max_bone_stretch, 0.5, 10.0);
  v.Field("seed_along_bones", c.seed_along_bones);
  v.Field("bone_step_m", c.bone_step_m, 0.01, 1.0);
  v.Field("bone_depth_m", c.bone_depth_m, 0.01, 1.0);
  v.Field("seed_extremities", c.seed_extremities);
  v.Field("arm_radius_share", c.arm_radius_share, 0.1, 1.0);
  v.Field("leg_radius_share", c.leg_radius_share, 0.1, 1.0);
  v.Field("min_depth_m", c.min_depth_m, 0.0, 5.0);
  v.Field("max_depth_m", c.max_depth_m, 0.5, 50.0);
}

/// A point on the surface of a person.
struct Seed {
  cv::Point2f pixel;         ///< incoming pixel grid
  Eigen::Vector3f p_camera;  ///< metres
  float radius_share = 1;    ///< see BodyPoint

  BodyPoint OnBody() const { return {p_camera, radius_share}; }
};

/// What is known of a person from keypoints and depth.
struct PersonSeeds {
  std::vector<Seed> seeds;  ///< joints first, then points along bones and beyond
  std::vector<UnseenPart>
      unseen_parts;            ///< limbs may reach these places: no plane is looked for there
  int num_joints = 0;          ///< of the seeds
  int num_certain_joints = 0;  ///< of the same
  std::array<bool, kNumCocoJoints> found{};  ///< joints that were lifted
  float body_depth_m = 0;                    ///< of most joints; 0 when nothing was lifted
};

/// Lifts the joints of a person to 3-D with the pinhole model, distortion included, and adds points
/// along the bones.
///
/// Depth of a joint is the median of one surface of those that its neighbourhood shows: of those
/// that agree with the depth of the body, the nearest. Joints without depth, on something else
/// (a wall behind, a table before the person) or too far from their neighbours in the skeleton are
/// dropped. No seeds come back when nothing can be lifted. `gravity`: unit vector downwards in the
/// camera frame, where legs that were not found are; down the image without it. Thread-safe.
PersonSeeds LiftPerson(const Skeleton& skeleton, const RgbdFrame& frame, const SeedConfig& config,
                       const std::optional<Eigen::Vector3f>& gravity = std::nullopt);

}  // namespace posefusion
