#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "posefusion/dataset/triangle_mesh.h"
#include "posefusion/simulation/material.h"
#include "posefusion/simulation/room_plan.h"

namespace posefusion {

/// Light from six sides at one place: +x -x +y -y +z -z, linear R G B.
using LightCube = std::array<Eigen::Vector3f, 6>;

/// Light in a room that does not change: lamps and windows as areas with shadows, and what
/// surfaces around reflect once. Thread-safe.
class LightBake {
 public:
  /// `scene` holds `mesh` as its geometry 0; all must outlive this.
  LightBake(RTCScene scene, const TriangleMesh& mesh, const std::vector<Material>& materials,
            const std::vector<AreaLight>& lights);

  /// Light that a surface reflects, before its colour, at a place of the map.
  Eigen::Vector3f Irradiance(const Eigen::Vector3f& p_map, const Eigen::Vector3f& normal) const;

  LightCube CubeAt(const Eigen::Vector3f& p_map) const;

 private:
  bool IsVisible(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;
  Eigen::Vector3f Direct(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;
  Eigen::Vector3f Reflected(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;

  RTCScene scene_;
  const TriangleMesh& mesh_;
  std::vector<Eigen::Vector3f> reflectance_;  ///< mean colour by material
  const std::vector<AreaLight>& lights_;
};

}  // namespace posefusion
