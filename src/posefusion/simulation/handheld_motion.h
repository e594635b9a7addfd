#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/simulation/head_motion.h"
#include "posefusion/simulation/sweep_sequence.h"
#include "posefusion/simulation/wander.h"

namespace posefusion {

/// The four camera motions of the TUM RGB-D benchmark's dynamic sequences (Sturm 2012).
enum class HandheldKind {
  kStatic,      ///< held still
  kXyz,         ///< along the three axes, direction kept
  kRpy,         ///< about the three axes, mostly in place
  kHalfsphere,  ///< on a half sphere about a point, looking at it
};

/// A camera held in the hands in front of the table of RoomKind::kLab. Amplitudes and speeds are
/// those of the freiburg3 walking sequences.
class HandheldMotion : public HeadMotion {
 public:
  HandheldMotion(HandheldKind kind, int seed, double seconds);

  Eigen::Isometry3d T_map_camera(double time_s) const override;

 private:
  Eigen::Isometry3d T_map_held(double time_s) const;

  HandheldKind kind_;
  double seconds_;
  SweepSequence sweeps_;
  std::vector<Wander> tremor_;  ///< translation, then rotation, camera axes
};

/// Optical frame at `position`, looking at `target`, its x axis horizontal; map frame, metres.
/// The two must not be one above the other.
Eigen::Isometry3d LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

}  // namespace posefusion
