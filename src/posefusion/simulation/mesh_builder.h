#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/dataset/triangle_mesh.h"

namespace posefusion {

/// How the texture lies on a patch.
struct Skin {
  std::uint8_t material = 0;
  double repeat_m = 1;       ///< width of one repeat; 0 = `cell` of the texture fits the patch once
  Eigen::AlignedBox2f cell;  ///< in repeats; only for repeat_m = 0
};

/// One elliptic cross-section of a body part, at z in the part's frame.
struct Ring {
  double z_m;
  double half_width_m;   ///< along y
  double half_depth_m;   ///< along x
  double forward_m = 0;  ///< of its centre, along x
};

/// Collects the triangles of one mesh from simple shapes. Large faces are divided into cells so
/// that light can be stored at vertices.
class MeshBuilder {
 public:
  explicit MeshBuilder(double cell_m = 0.14) : cell_m_(cell_m) {}

  /// Shapes are placed by this until it is changed: mesh <- shape.
  void SetPlacement(const Eigen::Isometry3d& T_mesh_shape) { T_ = T_mesh_shape; }
  const Eigen::Isometry3d& placement() const { return T_; }

  /// A parallelogram as it is seen: corner at the top left, `right` and `down` along its edges.
  void AddPatch(const Eigen::Vector3d& top_left, const Eigen::Vector3d& right,
                const Eigen::Vector3d& down, const Skin& skin);

  /// All six faces with one skin.
  void AddBox(const Eigen::Vector3d& min, const Eigen::Vector3d& max, const Skin& skin);
  /// The face that looks along -y (in shapes' own frames: the front) has another skin.
  void AddBox(const Eigen::Vector3d& min, const Eigen::Vector3d& max, const Skin& skin,
              const Skin& front);

  /// Closed, along z, from `bottom`.
  void AddCylinder(const Eigen::Vector3d& bottom, double radius_m, double height_m,
                   const Skin& skin);

  /// A closed surface through rings in order of rising z. u runs around from the back (-x), v down.
  void AddRings(const std::vector<Ring>& rings, const Skin& skin);

  TriangleMesh Take() { return std::move(mesh_); }

 private:
  int AddVertex(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const Eigen::Vector2f& uv);
  void AddQuad(int a, int b, int c, int d, std::uint8_t material);
  void AddFace(const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
               const Eigen::Vector3d& up, const Eigen::Vector3d& half, const Skin& skin);

  double cell_m_;
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();
  TriangleMesh mesh_;
};

}  // namespace posefusion
