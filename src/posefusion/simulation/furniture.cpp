#include "posefusion/simulation/furniture.h"

#include <algorithm>

#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/material.h"

namespace posefusion::furniture {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Skin Tiled(std::uint8_t material, double repeat_m = 1.0) { return {material, repeat_m, {}}; }

Skin Whole(std::uint8_t material) {
  return {material, 0, {Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 1)}};
}

/// One of the spines of the books' picture, less its rim.
Skin Spine(int number) {
  const float u = 0.125F * static_cast<float>(number % 8);
  const float v = 0.5F * static_cast<float>((number / 8) % 2);
  return {
      kBooks, 0, {Eigen::Vector2f(u + 0.008F, v + 0.01F), Eigen::Vector2f(u + 0.117F, v + 0.49F)}};
}

Isometry3d Turned(const Vector3d& position, double yaw_rad) {
  return Eigen::Translation3d(position) * Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ());
}

/// Books from x_from to x_to standing on height z; some lean back from the edge.
void AddBooks(MeshBuilder& mesh, double x_from, double x_to, double z, double room_above,
              HashSequence& random) {
  double x = x_from;
  while (true) {
    const double width = static_cast<double>(random.Uniform(0.018F, 0.055F));
    const double height = std::min(static_cast<double>(random.Uniform(0.19F, 0.3F)), room_above);
    const double front = -0.12 + static_cast<double>(random.Uniform(-0.03F, 0.05F));
    const int spine = random.Below(16);
    if (x + width > x_to) break;
    if (random.Below(9) != 0) {
      mesh.AddBox({x, front, z}, {x + width - 0.002, 0.12, z + height}, Spine(spine + 3),
                  Spine(spine));
    }
    x += width;
  }
}

void AddScreen(MeshBuilder& mesh, const Isometry3d& T, std::uint8_t material) {
  mesh.SetPlacement(T);
  mesh.AddBox({-0.26, -0.015, 0.12}, {0.26, 0.02, 0.45}, Tiled(kBlackPlastic), Whole(material));
  mesh.AddBox({-0.03, 0.02, 0.005}, {0.03, 0.045, 0.32}, Tiled(kBlackPlastic));
  mesh.AddBox({-0.12, -0.08, 0.0}, {0.12, 0.1, 0.015}, Tiled(kBlackPlastic));
}

}  // namespace

void AddTable(MeshBuilder& mesh, const Isometry3d& T, double width, double depth,
              std::uint32_t seed) {
  mesh.SetPlacement(T);
  const double x = width / 2;
  const double y = depth / 2;
  const auto top = seed % 2 == 0 ? kTableWood : kShelfWood;
  mesh.AddBox({-x, -y, 0.70}, {x, y, 0.73}, Tiled(top, 0.9));
  mesh.AddBox({-x + 0.06, y - 0.09, 0.4}, {x - 0.06, y - 0.07, 0.70}, Tiled(kGreyPlastic));
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const Vector3d leg(sx * (x - 0.06), sy * (y - 0.06), 0);
      mesh.AddBox(leg - Vector3d(0.025, 0.025, 0), leg + Vector3d(0.025, 0.025, 0.70),
                  Tiled(kSteel, 0.3));
    }
  }
}

void AddDesktop(MeshBuilder& mesh, const Isometry3d& T, double width, double depth,
                std::uint32_t seed) {
  HashSequence random(seed, 77);
  const double z = 0.73;
  const auto some = [&](double range) {
    return range * static_cast<double>(random.Uniform(-1, 1));
  };
  AddScreen(mesh, T * Turned({-0.25 * width + some(0.05), 0.18, z}, some(0.3)), kScreenA);
  AddScreen(mesh, T * Turned({0.16 * width + some(0.05), 0.2, z}, some(0.3) - 0.2), kScreenB);
  mesh.SetPlacement(T * Turned({-0.22 * width, -0.12, z}, some(0.15)));
  mesh.AddBox({-0.22, -0.075, 0.0}, {0.22, 0.075, 0.012}, Tiled(kBlackPlastic));
  mesh.AddPatch({-0.215, 0.07, 0.0145}, {0.43, 0, 0}, {0, -0.14, 0}, Whole(kKeyboardSurface));
  mesh.SetPlacement(T * Turned({0.03 * width, -0.14, z}, some(0.3)));
  mesh.AddBox({-0.03, -0.05, 0.0}, {0.03, 0.05, 0.03}, Tiled(kGreyPlastic));
  for (int i = 0; i < 6; ++i) {
    const Vector3d place(0.28 * width + some(0.14), -0.12 + some(0.14), z + 0.001 + 0.002 * i);
    mesh.SetPlacement(T * Turned(place, some(0.8)));
    mesh.AddBox({-0.105, -0.148, 0.0}, {0.105, 0.148, 0.0015}, Whole(kPaper));
  }
  mesh.SetPlacement(T);
  mesh.AddCylinder({0.03 * width, 0.02, z}, 0.042, 0.1, Tiled(kMug, 0.2));
  mesh.AddCylinder({-0.46 * width, -0.3 * depth, z}, 0.04, 0.09, Tiled(kSteel, 0.2));
  mesh.SetPlacement(T * Turned({0.44 * width, 0.25, z}, 0.25));
  AddBooks(mesh, -0.09, 0.09, 0, 0.3, random);
}

void AddChair(MeshBuilder& mesh, const Isometry3d& T, std::uint8_t cloth) {
  mesh.SetPlacement(T);
  const double seat = kSeatHeight;
  mesh.AddBox({-0.22, -0.22, seat - 0.06}, {0.22, 0.22, seat}, Tiled(cloth, 0.25));
  mesh.AddBox({-0.2, 0.2, seat + 0.16}, {0.2, 0.25, seat + 0.5}, Tiled(cloth, 0.25));
  for (const double x : {-0.2, 0.17}) {
    mesh.AddBox({x, 0.19, 0}, {x + 0.03, 0.22, seat + 0.2}, Tiled(kSteel, 0.2));
    mesh.AddBox({x, -0.21, 0}, {x + 0.03, -0.18, seat - 0.06}, Tiled(kSteel, 0.2));
  }
}

void AddBookShelf(MeshBuilder& mesh, const Isometry3d& T, double width, double height,
                  std::uint32_t seed) {
  HashSequence random(seed, 78);
  const double x = width / 2;
  const Skin wood = Tiled(kShelfWood, 0.8);
  mesh.SetPlacement(T);
  for (const double side : {-x, x - 0.02}) {
    mesh.AddBox({side, -0.15, 0}, {side + 0.02, 0.15, height}, wood);
  }
  mesh.AddPatch({-x, 0.14, height}, {width, 0, 0}, {0, 0, -height}, wood);
  const int shelves = std::max(1, static_cast<int>(height / 0.36));
  const double spacing = (height - 0.08) / shelves;
  for (int i = 0; i <= shelves; ++i) {
    const double z = 0.06 + spacing * i;
    mesh.AddBox({-x + 0.02, -0.15, z - 0.02}, {x - 0.02, 0.14, z}, wood);
    if (i == shelves) break;
    double from = -x + 0.03;
    while (from < x - 0.2) {
      const double to = std::min(from + static_cast<double>(random.Uniform(0.25F, 0.7F)), x - 0.03);
      if (random.Below(4) == 0) {
        const double size = std::min(to - from - 0.04, 0.34);
        mesh.AddBox({from + 0.02, -0.11, z}, {from + 0.02 + size, 0.12, z + 0.2},
                    Whole(kCardboardSurface));
      } else {
        AddBooks(mesh, from, to, z, spacing - 0.04, random);
      }
      from = to;
    }
  }
}

void AddCupboard(MeshBuilder& mesh, const Isometry3d& T, double width, double height,
                 bool with_things, std::uint32_t seed) {
  mesh.SetPlacement(T);
  const double x = width / 2;
  mesh.AddBox({-x, -0.2, 0.06}, {x, 0.2, height}, Tiled(kWhiteLacquer, 0.5));
  mesh.AddBox({-x + 0.02, -0.17, 0}, {x - 0.02, 0.18, 0.06}, Tiled(kBlackPlastic));
  const int doors = std::max(1, static_cast<int>(width / 0.5));
  for (int i = 0; i < doors; ++i) {
    const double from = -x + width * i / doors;
    const double to = from + width / doors;
    mesh.AddBox({from + 0.006, -0.215, 0.08}, {to - 0.006, -0.2, height - 0.02},
                Tiled(seed % 2 == 0 ? kTableWood : kWhiteLacquer, 0.9));
    mesh.AddBox({to - 0.05, -0.235, height / 2}, {to - 0.035, -0.215, height / 2 + 0.14},
                Tiled(kSteel, 0.2));
  }
  if (!with_things) return;
  HashSequence random(seed, 79);
  AddBooks(mesh, -x + 0.05, -x + 0.4, height, 0.3, random);
  mesh.AddBox({-0.1, -0.14, height}, {0.34, 0.16, height + 0.2}, Tiled(kGreyPlastic),
              Tiled(kWhiteLacquer));
  mesh.AddBox({-0.04, -0.15, height + 0.06}, {0.28, -0.14, height + 0.09}, Tiled(kBlackPlastic));
  AddPlant(mesh, T * Turned({x - 0.18, 0, height}, 0), 0.45, seed);
}

void AddPlant(MeshBuilder& mesh, const Isometry3d& T, double height, std::uint32_t seed) {
  HashSequence random(seed, 80);
  const double pot = 0.25 * height;
  mesh.SetPlacement(T);
  mesh.AddRings({{0, pot * 0.35, pot * 0.35}, {pot, pot * 0.5, pot * 0.5}}, Tiled(kClayPot, 0.3));
  for (int i = 0; i < 26; ++i) {
    const double yaw = static_cast<double>(random.Uniform(0, 6.28F));
    const double lean = static_cast<double>(random.Uniform(0.1F, 0.9F));
    const double length = (height - pot) * static_cast<double>(random.Uniform(0.5F, 1.0F));
    mesh.SetPlacement(T * Turned({0, 0, pot * 0.95}, yaw) *
                      Eigen::AngleAxisd(lean, Vector3d::UnitX()));
    const double width = 0.09 * height;
    mesh.AddBox({-width, -0.002, 0.2 * length}, {width, 0.002, length}, Tiled(kLeaf, 0.4));
    mesh.AddBox({-0.004, -0.004, 0}, {0.004, 0.004, 0.25 * length}, Tiled(kLeaf, 0.4));
  }
}

void AddPicture(MeshBuilder& mesh, const Isometry3d& T, double width, double height, double z,
                std::uint8_t material) {
  mesh.SetPlacement(T);
  mesh.AddBox({-width / 2, -0.014, z - height / 2}, {width / 2, -0.002, z + height / 2},
              Tiled(kWhiteLacquer), Whole(material));
}

void AddWindow(MeshBuilder& mesh, const Isometry3d& T, double width) {
  mesh.SetPlacement(T);
  const double x = width / 2;
  const double low = 0.95;
  const double high = 2.2;
  const Skin white = Tiled(kWhiteLacquer, 0.5);
  mesh.AddPatch({-x, -0.004, high}, {width, 0, 0}, {0, 0, low - high}, Whole(kSky));
  mesh.AddBox({-x - 0.06, -0.05, low - 0.06}, {x + 0.06, 0, low}, white);
  mesh.AddBox({-x - 0.06, -0.05, high}, {x + 0.06, 0, high + 0.06}, white);
  for (const double bar : {-x - 0.06, -0.025, x}) {
    mesh.AddBox({bar, -0.05, low}, {bar + 0.06, 0, high}, white);
  }
  mesh.AddBox({-x - 0.1, -0.2, low - 0.09}, {x + 0.1, 0, low - 0.06}, white);
  for (int fold = 0; fold < 8; ++fold) {
    const double side = fold < 4 ? -x - 0.02 - 0.07 * fold : x + 0.02 + 0.07 * (fold - 4);
    mesh.AddCylinder({side, -0.11, 0.9}, 0.04, 1.45, Tiled(kCurtain, 0.6));
  }
  mesh.AddBox({-x, -0.1, 0.15}, {x, -0.03, 0.75}, Tiled(kRadiatorSurface, 0.5));
}

void AddDoor(MeshBuilder& mesh, const Isometry3d& T) {
  mesh.SetPlacement(T);
  mesh.AddBox({-0.45, -0.03, 0.005}, {0.45, -0.003, 2.02}, Tiled(kDoorWood));
  for (const double side : {-0.53, 0.45}) {
    mesh.AddBox({side, -0.05, 0}, {side + 0.08, 0, 2.1}, Tiled(kWhiteLacquer, 0.5));
  }
  mesh.AddBox({-0.45, -0.05, 2.02}, {0.45, 0, 2.1}, Tiled(kWhiteLacquer, 0.5));
  mesh.AddBox({0.34, -0.08, 1.0}, {0.42, -0.03, 1.03}, Tiled(kSteel, 0.2));
}

void AddCardboardBox(MeshBuilder& mesh, const Isometry3d& T, const Vector3d& size) {
  mesh.SetPlacement(T);
  mesh.AddBox({-size.x() / 2, -size.y() / 2, 0}, {size.x() / 2, size.y() / 2, size.z()},
              Whole(kCardboardSurface));
}

void AddBackpack(MeshBuilder& mesh, const Isometry3d& T) {
  mesh.SetPlacement(T);
  mesh.AddRings({{0, 0.15, 0.1}, {0.08, 0.17, 0.12}, {0.3, 0.15, 0.1}, {0.4, 0.1, 0.06}},
                Tiled(kBackpack, 0.3));
}

}  // namespace posefusion::furniture
