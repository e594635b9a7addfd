#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace posefusion {

/// Which places of the floor a walking person can be at, and ways between them.
class FloorGrid {
 public:
  /// Obstacles are widened by `clearance_m`, the half width of who walks.
  FloorGrid(const Eigen::AlignedBox2d& floor, const std::vector<Eigen::AlignedBox2d>& obstacles,
            double clearance_m);

  bool IsFree(const Eigen::Vector2d& place) const;
  bool IsFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;  ///< straight line

  /// A short way with rounded corners from one place to another; both may lie within the clearance
  /// of an obstacle. Empty when there is none.
  std::vector<Eigen::Vector2d> Way(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  int CellOf(const Eigen::Vector2d& place) const;
  Eigen::Vector2d CenterOf(int cell) const;
  int NearestFree(int cell) const;
  std::vector<Eigen::Vector2d> CellPath(int from, int to) const;

  Eigen::AlignedBox2d floor_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> free_;
};

}  // namespace posefusion
