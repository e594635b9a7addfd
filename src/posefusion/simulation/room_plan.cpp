#include "posefusion/simulation/room_plan.h"

#include <string>

#include "posefusion/simulation/furniture.h"
#include "posefusion/simulation/material.h"
#include "posefusion/simulation/mesh_builder.h"

namespace posefusion {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeight = 2.6;
constexpr double kHalfWidth = 3.0;  // of a room, along x
constexpr double kHalfDepth = 2.5;  // along y
constexpr double kDoorHalf = 0.5;   // of an open doorway
constexpr double kDoorHeight = 2.1;

Isometry3d At(double x, double y, double yaw_rad) {
  return Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ());
}

/// Builds one room or corridor at a time; all coordinates are of the room, T_map_room places it.
class Builder {
 public:
  void Enter(const Isometry3d& T_map_room) { T_map_room_ = T_map_room; }
  RoomPlan& plan() { return plan_; }
  MeshBuilder& mesh() { return mesh_; }
  Isometry3d Place(double x, double y, double yaw_rad) const {
    return T_map_room_ * At(x, y, yaw_rad);
  }
  Vector2d OnFloor(double x, double y) const { return (T_map_room_ * Vector3d(x, y, 0)).head<2>(); }
  void Block(double x0, double y0, double x1, double y1) {
    AlignedBox2d box(OnFloor(x0, y0));
    box.extend(OnFloor(x1, y1));
    plan_.obstacles.push_back(box);
  }

  /// A wall whose left end is a and right end b (room x, y) as it is seen, with an open doorway
  /// around `door` metres from a, when positive.
  void AddWall(const Vector2d& a, const Vector2d& b, const Skin& skin, double door = -1) {
    mesh_.SetPlacement(T_map_room_);
    const Vector2d along = (b - a).normalized();
    const double length = (b - a).norm();
    const auto piece = [&](double from, double to, double bottom) {
      if (to - from < 1e-3) return;
      const Vector2d start = a + along * from;
      const Vector2d edge = along * (to - from);
      mesh_.AddPatch({start.x(), start.y(), kHeight}, {edge.x(), edge.y(), 0},
                     {0, 0, bottom - kHeight}, skin);
    };
    if (door < 0) return piece(0, length, 0);
    piece(0, door - kDoorHalf, 0);
    piece(door - kDoorHalf, door + kDoorHalf, kDoorHeight);
    piece(door + kDoorHalf, length, 0);
  }

  void AddFloorAndCeiling(const Vector2d& min, const Vector2d& max, const Skin& floor) {
    mesh_.SetPlacement(T_map_room_);
    const Vector2d size = max - min;
    mesh_.AddPatch({min.x(), max.y(), 0}, {size.x(), 0, 0}, {0, -size.y(), 0}, floor);
    mesh_.AddPatch({min.x(), min.y(), kHeight}, {size.x(), 0, 0}, {0, size.y(), 0},
                   {kCeiling, 1.2, {}});
  }

  void AddLamp(double x, double y) {
    mesh_.SetPlacement(T_map_room_);
    mesh_.AddPatch({x - 0.6, y - 0.15, kHeight - 0.03}, {1.2, 0, 0}, {0, 0.3, 0},
                   {kLampPanel, 1, {}});
    const Vector3d center = T_map_room_ * Vector3d(x, y, kHeight - 0.04);
    plan_.lights.push_back({center,
                            T_map_room_.linear() * Vector3d(0.6, 0, 0),
                            T_map_room_.linear() * Vector3d(0, 0.15, 0),
                            -Vector3d::UnitZ(),
                            {7.4F, 6.9F, 6.0F}});
  }

  void AddWindowAt(double x, double y, double yaw_rad) {
    const Isometry3d T = Place(x, y, yaw_rad);
    furniture::AddWindow(mesh_, T, 1.3);
    plan_.lights.push_back({T * Vector3d(0, -0.06, 1.57),
                            T.linear() * Vector3d(0.6, 0, 0),
                            Vector3d(0, 0, 0.6),
                            T.linear() * -Vector3d::UnitY(),
                            {2.6F, 3.0F, 3.5F}});
  }

  void AddChairWithSeat(double x, double y, double yaw_rad, std::uint8_t cloth, double side) {
    furniture::AddChair(mesh_, Place(x, y, yaw_rad), cloth);
    Block(x - 0.25, y - 0.25, x + 0.25, y + 0.25);
    const Isometry3d T = Place(x, y, yaw_rad - M_PI / 2);  // front is -y: the seat's x axis
    const Vector3d beside = T * Vector3d(0.0, side, 0);
    const Vector3d facing = T.linear() * Vector3d::UnitX();
    plan_.seats.push_back(
        {T.translation().head<2>(), std::atan2(facing.y(), facing.x()), beside.head<2>()});
  }

 private:
  Isometry3d T_map_room_ = Isometry3d::Identity();
  MeshBuilder mesh_;
  RoomPlan plan_;
};

/// Table with screens in the middle, a chair, a rug below.
void FurnishMiddle(Builder& b, std::uint32_t seed) {
  auto& mesh = b.mesh();
  furniture::AddTable(mesh, b.Place(0, 0, 0), 1.5, 0.8, seed);
  furniture::AddDesktop(mesh, b.Place(0, 0, 0), 1.5, 0.8, seed);
  b.Block(-0.75, -0.4, 0.75, 0.4);
  b.AddChairWithSeat(-0.42, -0.64, M_PI, seed % 2 == 0 ? kSeatRed : kSeatBlue, 0.5);
  mesh.SetPlacement(b.Place(0, 0, 0));
  mesh.AddBox({-1.3, -0.9, 0.0005}, {1.3, 0.9, 0.008}, {kRug, 2.6, {}});
}

/// Furniture along the four walls: shelves and posters beside the door (-y), a blank wall (+x),
/// windows (+y), whiteboard, cupboard and shelf (-x).
void FurnishWalls(Builder& b, std::uint32_t seed) {
  using namespace furniture;
  auto& mesh = b.mesh();
  AddBookShelf(mesh, b.Place(-1.75, -kHalfDepth + 0.17, M_PI), 1.7, 1.95, seed);
  b.Block(-2.6, -kHalfDepth, -0.9, -kHalfDepth + 0.34);
  AddPicture(mesh, b.Place(1.3, -kHalfDepth, M_PI), 0.85, 1.1, 1.5,
             static_cast<std::uint8_t>(kPosterA + seed % 4));
  AddPicture(mesh, b.Place(2.35, -kHalfDepth, M_PI), 0.9, 0.7, 1.6, kCork);
  b.AddWindowAt(-1.3, kHalfDepth, 0);
  b.AddWindowAt(1.2, kHalfDepth, 0);
  AddPlant(mesh, b.Place(2.65, 2.15, 0), 1.5, seed);
  b.Block(2.45, 1.95, 2.85, 2.35);
  AddPicture(mesh, b.Place(-kHalfWidth, 0.9, M_PI / 2), 1.5, 1.0, 1.5, kWhiteboardSurface);
  AddPicture(mesh, b.Place(-kHalfWidth, -0.75, M_PI / 2), 0.7, 0.95, 1.65,
             static_cast<std::uint8_t>(kPosterA + (seed + 1) % 4));
  AddCupboard(mesh, b.Place(-kHalfWidth + 0.22, -0.75, M_PI / 2), 1.5, 0.85, true, seed);
  b.Block(-kHalfWidth, -1.5, -kHalfWidth + 0.45, 0.0);
  AddCardboardBox(mesh, b.Place(-2.72, 1.95, 0.2), {0.4, 0.32, 0.3});
  AddCardboardBox(mesh, b.Place(-2.7, 1.5, -0.1), {0.36, 0.4, 0.26});
  b.Block(-3.0, 1.3, -2.48, 2.2);
}

void AddShell(Builder& b, double door, std::uint8_t floor) {
  const double x = kHalfWidth;
  const double y = kHalfDepth;
  const Skin paper{kWallpaper, 0.5, {}};
  b.AddFloorAndCeiling({-x, -y}, {x, y}, {floor, floor == kBoards ? 2.0 : 0.9, {}});
  b.AddWall({-x, y}, {x, y}, paper);                 // windows
  b.AddWall({x, y}, {x, -y}, {kBlankPaint, 1, {}});  // the blank wall
  b.AddWall({x, -y}, {-x, -y}, paper, door);         // the door's wall
  b.AddWall({-x, -y}, {-x, y}, paper);
  b.AddLamp(-1.2, 0);
  b.AddLamp(1.2, 0);
}

void AddPlaces(Builder& b) {
  for (const auto& [x, y] : {std::pair{-2.0, 1.7},
                             {2.3, 1.3},
                             {2.2, -1.2},
                             {0.0, -1.75},
                             {0, 1.75},
                             {-2.1, -1.75},
                             {-1.9, 0.4},
                             {1.2, -1.1}}) {
    b.plan().places.push_back(b.OnFloor(x, y));
  }
}

/// Things that will be moved, and where to.
void AddObjects(Builder& b) {
  const auto add = [&](const std::string& name, const Isometry3d& from, double x, double y) {
    Isometry3d to = from;
    to.translation().head<2>() = b.OnFloor(x, y);
    b.plan().objects.push_back({name, from, to});
  };
  add("chair", b.Place(-0.35, 0.72, M_PI / 2), 0.35, 0.72);
  add("backpack", b.Place(2.62, -1.2, 1.2), 2.62, 0.5);
  add("box", b.Place(2.55, -2.2, 0.3), -0.6, -2.25);
}

/// Wall lining of the doorway between a room and the corridor, 0.1 m thick.
void AddDoorway(Builder& b) {
  auto& mesh = b.mesh();
  mesh.SetPlacement(b.Place(0, -kHalfDepth - 0.05, 0));
  const Skin white{kWhiteLacquer, 0.5, {}};
  for (const double side : {-kDoorHalf - 0.03, kDoorHalf}) {
    mesh.AddBox({side, -0.07, 0}, {side + 0.03, 0.07, kDoorHeight}, white);
  }
  mesh.AddBox({-kDoorHalf, -0.07, kDoorHeight - 0.03}, {kDoorHalf, 0.07, kDoorHeight}, white);
  mesh.AddBox({-kDoorHalf, -0.05, -0.02}, {kDoorHalf, 0.05, 0.004}, {kSteel, 0.3, {}});
}

void AddRoom(Builder& b, const Isometry3d& T_map_room, std::uint32_t seed) {
  b.Enter(T_map_room);
  AddShell(b, kHalfWidth, seed % 2 == 0 ? kBoards : kLinoleum);
  AddDoorway(b);
  FurnishMiddle(b, seed);
  FurnishWalls(b, seed);
  AddPlaces(b);
  if (b.plan().objects.empty()) AddObjects(b);
  b.Block(-kHalfWidth, -kHalfDepth - 0.1, -kDoorHalf, -kHalfDepth);
  b.Block(kDoorHalf, -kHalfDepth - 0.1, kHalfWidth, -kHalfDepth);
}

RoomPlan Lab() {
  Builder b;
  AddRoom(b, Isometry3d::Identity(), 2);
  const Skin paper{kWallpaper, 0.5, {}};
  const double near = -kHalfDepth - 0.1;
  const double far = near - 1.5;
  b.AddFloorAndCeiling({-3, far}, {3, near}, {kLinoleum, 0.9, {}});
  b.AddWall({-3, near}, {3, near}, paper, 3);
  b.AddWall({3, far}, {-3, far}, {kBlankPaint, 1, {}});
  b.AddWall({3, near}, {3, far}, paper);
  b.AddWall({-3, far}, {-3, near}, paper);
  b.AddLamp(0, -3.3);
  furniture::AddPicture(b.mesh(), b.Place(0.2, far, M_PI), 0.7, 0.95, 1.55, kPosterD);
  b.plan().outside = {{2.3, -3.3}, {-2.3, -3.3}};
  b.plan().floor = AlignedBox2d(Vector2d(-kHalfWidth, far), Vector2d(kHalfWidth, kHalfDepth));
  b.plan().mesh = b.mesh().Take();
  return b.plan();
}

void FurnishCorridor(Builder& b) {
  using namespace furniture;
  auto& mesh = b.mesh();
  for (int i = 0; i < 4; ++i) {
    AddPicture(mesh, b.Place(6.9 + 0.0 * i + 2.0 * i, 1.0, 0), 0.7, 0.95, 1.55,
               static_cast<std::uint8_t>(kPosterA + i));
  }
  AddPicture(mesh, b.Place(2.5, -1.0, M_PI), 1.2, 0.9, 1.5, kCork);
  AddPicture(mesh, b.Place(17.5, -1.0, M_PI), 0.7, 0.95, 1.55, kPosterC);
  AddDoor(mesh, b.Place(5.5, -1.0, M_PI));
  AddDoor(mesh, b.Place(21.5, -1.0, M_PI));
  AddDoor(mesh, b.Place(14.8, 1.0, 0));
  AddCupboard(mesh, b.Place(15.6, -0.78, M_PI), 1.2, 1.0, true, 5);
  b.Block(15.0, -1.0, 16.2, -0.55);
  AddPlant(mesh, b.Place(0.35, -0.65, 0), 1.4, 9);
  b.Block(0.15, -0.85, 0.55, -0.45);
  AddPicture(mesh, b.Place(26.0, 0, -M_PI / 2), 1.2, 0.9, 1.5, kPosterD);
  for (double x = 2; x < 26; x += 4.4) b.AddLamp(x, 0);
  for (double x = 1.5; x < 26; x += 4) b.plan().places.push_back({x, x > 13 ? 0.5 : -0.4});
}

RoomPlan Corridor() {
  Builder b;
  AddRoom(b, At(3.0, 1.1 + kHalfDepth, 0), 2);
  AddRoom(b, At(11.0, -1.1 - kHalfDepth, M_PI), 3);
  AddRoom(b, At(20.0, 1.1 + kHalfDepth, 0), 4);
  b.Enter(Isometry3d::Identity());
  const Skin paper{kWallpaper, 0.5, {}};
  b.AddFloorAndCeiling({0, -1}, {26, 1}, {kLinoleum, 0.9, {}});
  b.AddWall({0, 1}, {6.2, 1}, paper, 3);
  b.AddWall({6.2, 1}, {16.5, 1}, paper);
  b.AddWall({16.5, 1}, {26, 1}, paper, 3.5);
  b.AddWall({26, 1}, {26, -1}, paper);
  b.AddWall({26, -1}, {0, -1}, {kBlankPaint, 1, {}}, 15);
  b.AddWall({0, -1}, {0, 1}, paper);
  FurnishCorridor(b);
  // Behind the corridor's walls, where there is no room.
  b.Block(6, 1, 17, 6.1);
  b.Block(23, 1, 26, 6.1);
  b.Block(0, -6.1, 8, -1);
  b.Block(14, -6.1, 26, -1);
  b.plan().outside = {{25.3, 0.3}, {0.9, 0.4}};
  b.plan().floor = AlignedBox2d(Vector2d(0, -6.1), Vector2d(26, 6.1));
  b.plan().mesh = b.mesh().Take();
  return b.plan();
}

}  // namespace

RoomPlan MakeRoomPlan(RoomKind room) { return room == RoomKind::kLab ? Lab() : Corridor(); }

}  // namespace posefusion
