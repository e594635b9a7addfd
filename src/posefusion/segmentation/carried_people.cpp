#include "posefusion/segmentation/carried_people.h"

#include <algorithm>
#include <cmath>

#include "posefusion/image/depth_noise.h"

namespace posefusion {
namespace {

/// Whether cells of the same surface around (x, y) agree on who they are.
bool IsPure(const CellPeople& people, const CellGrid& cells, int x, int y, float layer_gap_m) {
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
      const int u = static_cast<int>(std::lround(static_cast<float>(x) + moved[x][0]));
      const int v = static_cast<int>(std::lround(static_cast<float>(y) + moved[x][1]));
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      const float z = cells_now.DepthAt(x, y);
      const float z_before = cells_before.DepthAt(u, v);
      if (z <= 0 || z_before <= 0) continue;
      const float limit = step_m + static_cast<float>(config.depth_sigmas) * DepthSigma(noise, z);
      if (std::abs(z - z_before) > limit) continue;
      const CellPerson person = before.person.at(u, v);
      if (person == kUnknownCell || !IsPure(before, cells_before, u, v, gap_m)) continue;
      now.person.at(x, y) = person;
      now.evidence.at(x, y) = before.evidence.at(u, v);
    }
  }
}

}  // namespace posefusion
