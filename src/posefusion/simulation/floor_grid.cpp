#include "posefusion/simulation/floor_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace posefusion {
namespace {

using Eigen::Vector2d;

constexpr double kCell = 0.08;  // metres

/// Cuts every corner at a quarter of its edges, twice (Chaikin's curve).
std::vector<Vector2d> Rounded(std::vector<Vector2d> line) {
  for (int round = 0; round < 2; ++round) {
    if (line.size() < 3) return line;
    std::vector<Vector2d> smooth{line.front()};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      if (i > 0) smooth.push_back(0.75 * line[i] + 0.25 * line[i + 1]);
      if (i + 2 < line.size()) smooth.push_back(0.25 * line[i] + 0.75 * line[i + 1]);
    }
    smooth.push_back(line.back());
    line = std::move(smooth);
  }
  return line;
}

}  // namespace

FloorGrid::FloorGrid(const Eigen::AlignedBox2d& floor,
                     const std::vector<Eigen::AlignedBox2d>& obstacles, double clearance_m)
    : floor_(floor),
      columns_(static_cast<int>(std::ceil(floor.sizes().x() / kCell))),
      rows_(static_cast<int>(std::ceil(floor.sizes().y() / kCell))) {
  free_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (int cell = 0; cell < columns_ * rows_; ++cell) {
    const Vector2d center = CenterOf(cell);
    const Vector2d to_wall = (center - floor.min()).cwiseMin(floor.max() - center);
    bool is_free = to_wall.minCoeff() > clearance_m;
    for (const auto& box : obstacles) {
      if (box.exteriorDistance(center) < clearance_m) is_free = false;
    }
    free_[static_cast<std::size_t>(cell)] = is_free ? 1 : 0;
  }
}

int FloorGrid::CellOf(const Vector2d& place) const {
  const Vector2d cell = (place - floor_.min()) / kCell;
  const int column = std::clamp(static_cast<int>(cell.x()), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(cell.y()), 0, rows_ - 1);
  return row * columns_ + column;
}

Vector2d FloorGrid::CenterOf(int cell) const {
  return floor_.min() + kCell * Vector2d(cell % columns_ + 0.5, cell / columns_ + 0.5);
}

bool FloorGrid::IsFree(const Vector2d& place) const {
  return floor_.contains(place) && free_[static_cast<std::size_t>(CellOf(place))] != 0;
}

bool FloorGrid::IsFree(const Vector2d& from, const Vector2d& to) const {
  const int steps = static_cast<int>((to - from).norm() / (0.5 * kCell)) + 1;
  for (int i = 0; i <= steps; ++i) {
    if (!IsFree(from + (to - from) * i / steps)) return false;
  }
  return true;
}

int FloorGrid::NearestFree(int cell) const {
  const Vector2d place = CenterOf(cell);
  int best = -1;
  double best_distance = std::numeric_limits<double>::max();
  for (int other = 0; other < columns_ * rows_; ++other) {
    if (free_[static_cast<std::size_t>(other)] == 0) continue;
    const double distance = (CenterOf(other) - place).squaredNorm();
    if (distance < best_distance) {
      best_distance = distance;
      best = other;
    }
  }
  return best;
}

/// Dijkstra from `to`, then downhill from `from`. Ties go to the lower cell number.
std::vector<Vector2d> FloorGrid::CellPath(int from, int to) const {
  const double far = std::numeric_limits<double>::max();
  std::vector<double> cost(free_.size(), far);
  std::vector<int> next(free_.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[static_cast<std::size_t>(to)] = 0;
  open.emplace(0.0, to);
  while (!open.empty()) {
    const auto [value, cell] = open.top();
    open.pop();
    if (cell == from) break;
    if (value > cost[static_cast<std::size_t>(cell)]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = cell % columns_ + dx;
        const int y = cell / columns_ + dy;
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
        const auto other = static_cast<std::size_t>(y * columns_ + x);
        const double reached = value + std::hypot(dx, dy);
        if (free_[other] == 0 || reached >= cost[other]) continue;
        cost[other] = reached;
        next[other] = cell;
        open.emplace(reached, static_cast<int>(other));
      }
    }
  }
  std::vector<Vector2d> path;
  if (cost[static_cast<std::size_t>(from)] == far) return path;
  for (int cell = from; cell != -1; cell = next[static_cast<std::size_t>(cell)]) {
    path.push_back(CenterOf(cell));
  }
  return path;
}

std::vector<Vector2d> FloorGrid::Way(const Vector2d& from, const Vector2d& to) const {
  if (IsFree(from, to)) return {from, to};
  const int start = NearestFree(CellOf(from));
  const int end = NearestFree(CellOf(to));
  if (start < 0 || end < 0) return {};
  const std::vector<Vector2d> cells = CellPath(start, end);
  if (cells.empty()) return {};
  std::vector<Vector2d> way{from};
  std::size_t at = 0;
  if (!IsFree(from)) way.push_back(cells.front());
  while (at + 1 < cells.size()) {  // pull the string tight
    std::size_t reach = cells.size() - 1;
    while (reach > at + 1 && !IsFree(cells[at], cells[reach])) --reach;
    way.push_back(cells[reach]);
    at = reach;
  }
  if (IsFree(to)) way.back() = to;
  if (!IsFree(to)) way.push_back(to);
  return Rounded(way);
}

}  // namespace posefusion
