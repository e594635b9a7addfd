#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// A copy of surfels taken out of a map, for export, display and evaluation. Map frame, z up.
struct SurfelCloud {
  std::vector<Eigen::Vector3f> position_m;
  std::vector<Eigen::Vector3f> normal;  ///< unit length, towards the cameras that saw it
  std::vector<std::array<std::uint8_t, 3>> rgb;
  std::vector<float> radius_m;
  std::vector<float> confidence;
  std::vector<StampNs> first_seen_ns;
  std::vector<StampNs> last_seen_ns;

  std::size_t size() const { return position_m.size(); }
};

}  // namespace posefusion
