#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "posefusion/simulation/mesh_builder.h"

namespace posefusion::furniture {

/// Pieces of furniture. `T_map_item`: z up, standing on z = 0 around the origin, front towards -y.
/// Sizes in metres.

void AddTable(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double width, double depth,
              std::uint32_t seed);
/// Screens, keyboard, papers, mugs and a box on a table of that size.
void AddDesktop(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double width, double depth,
                std::uint32_t seed);

constexpr double kSeatHeight = 0.45;
void AddChair(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, std::uint8_t cloth);

/// Open shelves full of books and boxes.
void AddBookShelf(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double width,
                  double height, std::uint32_t seed);
/// A low cupboard with doors; `top` things stand on it when set.
void AddCupboard(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double width,
                 double height, bool with_things, std::uint32_t seed);
void AddPlant(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double height,
              std::uint32_t seed);

/// A flat picture on a wall behind the item frame's y = 0, its centre at height `z`.
void AddPicture(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double width, double height,
                double z, std::uint8_t material);
/// Window with frame, sky, curtains and a radiator below.
void AddWindow(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item, double width);
void AddDoor(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item);
void AddCardboardBox(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item,
                     const Eigen::Vector3d& size);
void AddBackpack(MeshBuilder& mesh, const Eigen::Isometry3d& T_map_item);

}  // namespace posefusion::furniture
