#include "posefusion/simulation/mesh_builder.h"

#include <algorithm>
#include <cmath>

namespace posefusion {

using Eigen::Vector2f;
using Eigen::Vector3d;

int MeshBuilder::AddVertex(const Vector3d& p, const Vector3d& normal, const Vector2f& uv) {
  mesh_.vertices.push_back((T_ * p).cast<float>());
  mesh_.normals.push_back((T_.linear() * normal).normalized().cast<float>());
  mesh_.uv.push_back(uv);
  return static_cast<int>(mesh_.vertices.size()) - 1;
}

void MeshBuilder::AddQuad(int a, int b, int c, int d, std::uint8_t material) {
  mesh_.triangles.emplace_back(a, b, c);
  mesh_.triangles.emplace_back(a, c, d);
  mesh_.materials.push_back(material);
  mesh_.materials.push_back(material);
}

void MeshBuilder::AddPatch(const Vector3d& top_left, const Vector3d& right, const Vector3d& down,
                           const Skin& skin) {
  const int columns = std::max(1, static_cast<int>(std::ceil(right.norm() / cell_m_)));
  const int rows = std::max(1, static_cast<int>(std::ceil(down.norm() / cell_m_)));
  const Vector3d normal = down.cross(right);
  const Vector2f size = skin.repeat_m > 0
                            ? Vector2f(right.norm() / skin.repeat_m, down.norm() / skin.repeat_m)
                            : Vector2f(skin.cell.sizes());
  const int first = static_cast<int>(mesh_.vertices.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double s = static_cast<double>(column) / columns;
      const double t = static_cast<double>(row) / rows;
      const Vector2f uv(static_cast<float>(s) * size.x(), static_cast<float>(t) * size.y());
      AddVertex(top_left + s * right + t * down, normal,
                uv + (skin.repeat_m > 0 ? Vector2f::Zero().eval() : skin.cell.min()));
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int a = first + row * (columns + 1) + column;
      AddQuad(a, a + 1, a + columns + 2, a + columns + 1, skin.material);
    }
  }
}

void MeshBuilder::AddFace(const Vector3d& center, const Vector3d& normal, const Vector3d& up,
                          const Vector3d& half, const Skin& skin) {
  const Vector3d right = up.cross(normal);
  const Vector3d to_right = right * half.dot(right.cwiseAbs());
  const Vector3d to_top = up * half.dot(up.cwiseAbs());
  const Vector3d face = center + normal * half.dot(normal.cwiseAbs());
  AddPatch(face - to_right + to_top, 2 * to_right, -2 * to_top, skin);
}

void MeshBuilder::AddBox(const Vector3d& min, const Vector3d& max, const Skin& skin) {
  AddBox(min, max, skin, skin);
}

void MeshBuilder::AddBox(const Vector3d& min, const Vector3d& max, const Skin& skin,
                         const Skin& front) {
  const Vector3d center = (min + max) / 2;
  const Vector3d half = (max - min) / 2;
  AddFace(center, -Vector3d::UnitY(), Vector3d::UnitZ(), half, front);
  for (const Vector3d& normal : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0)}) {
    AddFace(center, normal, Vector3d::UnitZ(), half, skin);
  }
  for (const double side : {-1.0, 1.0}) {
    AddFace(center, side * Vector3d::UnitZ(), Vector3d::UnitY(), half, skin);
  }
}

void MeshBuilder::AddCylinder(const Vector3d& bottom, double radius_m, double height_m,
                              const Skin& skin) {
  const Eigen::Isometry3d before = T_;
  T_ = T_ * Eigen::Translation3d(bottom);
  AddRings({{0, radius_m, radius_m}, {height_m, radius_m, radius_m}}, skin);
  T_ = before;
}

void MeshBuilder::AddRings(const std::vector<Ring>& rings, const Skin& skin) {
  constexpr int kSides = 20;
  const int first = static_cast<int>(mesh_.vertices.size());
  const double bottom = rings.front().z_m;
  const double height = rings.back().z_m - bottom;
  const auto add_ring = [&](const Ring& ring, double slope, double normal_z) {
    for (int i = 0; i <= kSides; ++i) {
      const double angle = 2 * M_PI * i / kSides - M_PI;
      const Vector3d around(std::cos(angle) * ring.half_depth_m,
                            std::sin(angle) * ring.half_width_m, 0);
      Vector3d normal(std::cos(angle) * ring.half_width_m, std::sin(angle) * ring.half_depth_m, 0);
      normal = normal.norm() > 1e-9 ? normal.normalized().eval() : Vector3d::Zero();
      normal.z() = -slope + normal_z;
      const double scale = skin.repeat_m > 0 ? skin.repeat_m : 1;
      const double u = skin.repeat_m > 0 ? angle * ring.half_width_m / scale : i / double(kSides);
      const double v = skin.repeat_m > 0 ? -ring.z_m / scale : 1 - (ring.z_m - bottom) / height;
      AddVertex(around + Vector3d(ring.forward_m, 0, ring.z_m), normal,
                Vector2f(static_cast<float>(u), static_cast<float>(v)));
    }
  };
  const auto mean_radius = [](const Ring& r) { return (r.half_width_m + r.half_depth_m) / 2; };
  const int count = static_cast<int>(rings.size());
  const auto ring_at = [&](int i) { return rings[static_cast<std::size_t>(i)]; };
  Ring pole = rings.front();
  pole.half_width_m = pole.half_depth_m = 1e-4;
  add_ring(pole, 0, -1);
  for (int i = 0; i < count; ++i) {
    const Ring below = ring_at(std::max(i - 1, 0));
    const Ring above = ring_at(std::min(i + 1, count - 1));
    const double rise = std::max(above.z_m - below.z_m, 1e-6);
    add_ring(ring_at(i), (mean_radius(above) - mean_radius(below)) / rise, 0);
  }
  pole = rings.back();
  pole.half_width_m = pole.half_depth_m = 1e-4;
  add_ring(pole, 0, 1);
  for (int ring = 0; ring <= count; ++ring) {
    for (int i = 0; i < kSides; ++i) {
      const int a = first + ring * (kSides + 1) + i;
      AddQuad(a, a + 1, a + kSides + 2, a + kSides + 1, skin.material);
    }
  }
}

}  // namespace posefusion
