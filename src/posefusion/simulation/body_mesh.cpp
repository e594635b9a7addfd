#include <utility>

#include "posefusion/simulation/body.h"
#include "posefusion/simulation/material.h"
#include "posefusion/simulation/mesh_builder.h"

namespace posefusion {
namespace {

TriangleMesh FromRings(const std::vector<Ring>& rings, const Skin& skin) {
  MeshBuilder mesh;
  mesh.AddRings(rings, skin);
  return mesh.Take();
}

/// A limb hanging from its joint: radii at the joint, at the belly of the muscle, at the far end.
TriangleMesh Limb(double length, double top, double belly, double end, const Skin& skin) {
  const double r = end * 0.6;
  return FromRings({{-length - end * 0.7, r, r},
                    {-length, end, end},
                    {-0.7 * length, (belly + end) / 2, (belly + end) / 2},
                    {-0.35 * length, belly, belly * 1.06},
                    {-0.08 * length, top, top},
                    {top * 0.35, top * 0.8, top * 0.8},
                    {top * 0.6, top * 0.45, top * 0.45}},
                   skin);
}

TriangleMesh Pelvis(const BodyShape& s, const Skin& skin) {
  const double w = (s.hip_half + 0.085) * s.girth;
  const double d = 0.125 * s.girth;
  return FromRings({{-0.12, 0.5 * w, 0.5 * d},
                    {-0.08, 0.85 * w, 0.95 * d, -0.012},
                    {0.0, w, d, -0.015},
                    {0.08, 0.97 * w, 0.95 * d, -0.005},
                    {0.2 * s.trunk + 0.03, 0.85 * w, 0.85 * d}},
                   skin);
}

TriangleMesh Chest(const BodyShape& s, const Skin& skin) {
  const double w = (s.shoulder_half + 0.01) * s.girth;
  const double d = 0.12 * s.girth;
  return FromRings({{-0.09, 0.80 * w, 1.08 * d},
                    {-0.06, 0.82 * w, 1.1 * d},
                    {0.12 * s.trunk, 0.84 * w, 1.0 * d, 0.01},
                    {0.4 * s.trunk, 0.97 * w, 1.05 * d, 0.015},
                    {0.58 * s.trunk, 1.04 * w, 1.0 * d, 0.008},
                    {0.69 * s.trunk, 1.06 * w, 0.86 * d},
                    {0.76 * s.trunk, 0.95 * w, 0.68 * d},
                    {0.82 * s.trunk, 0.62 * w, 0.56 * d},
                    {0.87 * s.trunk, 0.32 * w, 0.48 * d}},
                   skin);
}

TriangleMesh HeadMesh(const BodyShape& s, const Skin& skin) {
  const double h = s.head;
  const double r = 0.36 * h;
  MeshBuilder mesh;
  mesh.AddRings({{-0.12 * h, 0.45 * r, 0.4 * r, 0.35 * r},
                 {-0.03 * h, 0.68 * r, 0.85 * r, 0.2 * r},
                 {0.15 * h, 0.86 * r, 1.02 * r, 0.06 * r},
                 {0.4 * h, 1.0 * r, 1.12 * r, 0.0},
                 {0.62 * h, 1.04 * r, 1.2 * r, -0.04 * r},
                 {0.82 * h, 0.86 * r, 1.0 * r, -0.05 * r},
                 {0.94 * h, 0.52 * r, 0.62 * r, -0.05 * r},
                 {1.0 * h, 0.14 * r, 0.18 * r, -0.05 * r}},
                skin);
  Skin plain{static_cast<std::uint8_t>(skin.material - kHeadSurface + kSkin), 0.3, {}};
  Eigen::Isometry3d nose(Eigen::Translation3d(1.04 * r, 0, 0.3 * h));
  mesh.SetPlacement(nose);
  mesh.AddRings({{-0.01, 0.014, 0.022}, {0.012, 0.012, 0.016}, {0.05, 0.006, 0.006, -0.008}},
                plain);
  for (const double side : {-1.0, 1.0}) {
    mesh.SetPlacement(Eigen::Isometry3d(Eigen::Translation3d(0, side * 1.02 * r, 0.36 * h)));
    mesh.AddRings({{-0.03, 0.006, 0.008}, {0.0, 0.012, 0.02}, {0.03, 0.008, 0.016}}, plain);
  }
  return mesh.Take();
}

TriangleMesh Foot(const BodyShape& s, const Skin& skin) {
  MeshBuilder mesh;
  Eigen::Isometry3d along = Eigen::Isometry3d(Eigen::Translation3d(0, 0, -s.foot_height * 0.45)) *
                            Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY());
  mesh.SetPlacement(along);  // rings run from heel to toe; their depth is the shoe's height
  const double h = s.foot_height * 0.55;
  mesh.AddRings({{-0.27 * s.foot_length, 0.028, 0.8 * h},
                 {-0.2 * s.foot_length, 0.036, 1.2 * h, -0.2 * h},
                 {0.1 * s.foot_length, 0.042, 1.25 * h, -0.25 * h},
                 {0.45 * s.foot_length, 0.05, 0.85 * h, 0.15 * h},
                 {0.7 * s.foot_length, 0.042, 0.65 * h, 0.35 * h},
                 {0.78 * s.foot_length, 0.022, 0.4 * h, 0.5 * h}},
                skin);
  return mesh.Take();
}

TriangleMesh Hand(const BodyShape& s, const Skin& skin) {
  return FromRings({{-s.hand, 0.012, 0.026},
                    {-0.85 * s.hand, 0.016, 0.034},
                    {-0.45 * s.hand, 0.02, 0.043},
                    {-0.1 * s.hand, 0.023, 0.032},
                    {0.02, 0.022, 0.027}},
                   skin);
}

}  // namespace

std::array<TriangleMesh, kNumBodyParts> BodyMeshes(const BodyShape& s, int person) {
  const auto tiled = [&](PersonSurface surface, double repeat_m) {
    return Skin{PersonMaterial(person, surface), repeat_m, {}};
  };
  const Skin shirt = tiled(kShirt, 0.55);
  const Skin trousers = tiled(kTrousers, 0.5);
  const Skin skin = tiled(kSkin, 0.3);
  const Skin shoes = tiled(kShoes, 0.2);
  const double g = s.girth;
  const bool short_sleeves = person % 3 == 1;
  std::array<TriangleMesh, kNumBodyParts> parts;
  parts[kPelvis] = Pelvis(s, trousers);
  parts[kChest] = Chest(s, shirt);
  parts[kNeckPart] = FromRings({{-0.03, 0.058, 0.058}, {s.neck * 1.3, 0.052, 0.054, 0.01}}, skin);
  parts[kHead] = HeadMesh(s, Skin{PersonMaterial(person, kHeadSurface), 0, {}});
  for (const bool left : {false, true}) {
    parts[left ? kLeftUpperArm : kRightUpperArm] =
        Limb(s.upper_arm, 0.052 * g, 0.049 * g, 0.042 * g, shirt);
    parts[left ? kLeftForearm : kRightForearm] =
        Limb(s.forearm, 0.042 * g, 0.042 * g, 0.027, short_sleeves ? skin : shirt);
    parts[left ? kLeftHand : kRightHand] = Hand(s, skin);
    parts[left ? kLeftThigh : kRightThigh] =
        Limb(s.thigh, 0.085 * g, 0.083 * g, 0.06 * g, trousers);
    parts[left ? kLeftShank : kRightShank] = Limb(s.shank, 0.06 * g, 0.062 * g, 0.05, trousers);
    parts[left ? kLeftFoot : kRightFoot] = Foot(s, shoes);
  }
  return parts;
}

}  // namespace posefusion
