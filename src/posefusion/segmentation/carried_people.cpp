#include "posefusion/segmentation/carried_people.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "posefusion/image/depth_noise.h"

namespace posefusion {
namespace {

constexpr float kNearEnough = 0.2F;  ///< cells squared: no other one is known of a nearer place

/// Whether all cells around (x, y) are the same person.
bool IsAmongItsOwn(const CellPeople& people, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= people.person.width() || y + 1 >= people.person.height()) {
    return false;
  }
  const CellPerson person = people.person.at(x, y);
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (people.person.at(u, v) != person) return false;
    }
  }
  return true;
}

/// Whether cells of the same surface around (x, y) agree on who they are.
bool IsPure(const CellPeople& people, const CellGrid& cells, int x, int y, float layer_gap_m) {
  if (IsAmongItsOwn(people, x, y)) return true;
  const CellPerson person = people.person.at(x, y);
  const float depth = cells.DepthAt(x, y);
  int same = 0;
  int others = 0;
  for (int v = std::max(0, y - 1); v <= std::min(cells.height() - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(cells.width() - 1, x + 1); ++u) {
      const float z = cells.DepthAt(u, v);
      if (z <= 0 || std::abs(z - depth) > layer_gap_m) continue;
      const CellPerson other = people.person.at(u, v);
      same += other == person ? 1 : 0;
      others += other != person && other != kUnknownCell ? 1 : 0;
    }
  }
  return others <= same;
}

/// The cell whose knowledge is of the place nearest to this one; `place` becomes where that is from
/// here, cells.
std::optional<cv::Point> NearestKnown(const CellPeople& people, const cv::Point2f& at,
                                      cv::Vec2f& place) {
  const int column = static_cast<int>(std::lround(at.x));
  const int row = static_cast<int>(std::lround(at.y));
  const int width = people.person.width();
  const int height = people.person.height();
  if (column < 0 || row < 0 || column >= width || row >= height) return std::nullopt;
  const auto from_here = [&](int u, int v) {
    const cv::Vec2f offset = people.place.at(u, v);
    return cv::Vec2f(static_cast<float>(u) + offset[0] - at.x,
                     static_cast<float>(v) + offset[1] - at.y);
  };
  place = from_here(column, row);
  if (place.dot(place) < kNearEnough) return cv::Point(column, row);
  std::optional<cv::Point> nearest;
  float least = std::numeric_limits<float>::infinity();
  for (int v = std::max(0, row - 1); v <= std::min(height - 1, row + 1); ++v) {
    for (int u = std::max(0, column - 1); u <= std::min(width - 1, column + 1); ++u) {
      const cv::Vec2f there = from_here(u, v);
      const float squared = there.dot(there);
      if (squared >= least) continue;
      least = squared;
      nearest = cv::Point(u, v);
      place = there;
    }
  }
  return nearest;
}

}  // namespace

void CarryPeople(const CellPeople& before, const CellGrid& cells_before, const cv::Mat& motion,
                 const CellGrid& cells_now, double interval_s, const CarryConfig& config,
                 CellPeople& now) {
  const int width = cells_now.width();
  const int height = cells_now.height();
  const DepthNoiseConfig noise;
  const auto step_m = static_cast<float>(config.depth_step_m + config.depth_speed_m_s * interval_s);
  const auto gap_m = static_cast<float>(config.layer_gap_m);
  now.Forget(cells_now.size());
  for (int y = 0; y < height; ++y) {
    const auto* moved = motion.ptr<cv::Vec2f>(y);
    for (int x = 0; x < width; ++x) {
      const float z = cells_now.DepthAt(x, y);
      if (z <= 0) continue;
      const cv::Point2f came_from(static_cast<float>(x) + moved[x][0],
                                  static_cast<float>(y) + moved[x][1]);
      cv::Vec2f place;
      const auto cell = NearestKnown(before, came_from, place);
      if (!cell) continue;
      const int u = cell->x;
      const int v = cell->y;
      const float z_before = cells_before.DepthAt(u, v);
      if (z_before <= 0) continue;
      const float limit = step_m + static_cast<float>(config.depth_sigmas) * DepthSigma(noise, z);
      if (std::abs(z - z_before) > limit) continue;
      const CellPerson person = before.person.at(u, v);
      if (person == kUnknownCell || !IsPure(before, cells_before, u, v, gap_m)) continue;
      now.person.at(x, y) = person;
      now.evidence.at(x, y) = before.evidence.at(u, v);
      now.place.at(x, y) = place;
    }
  }
}

}  // namespace posefusion
