#include "posefusion/evaluation/disc_index.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace posefusion {
namespace {

constexpr float kCellM = 0.04F;  ///< a few surfels wide
constexpr int kPointsPerDisc = 128;
constexpr double kGoldenAngleRad = 2.399963229728653;  ///< pi (3 - sqrt 5)

/// A point of the disc. Points on a spiral that advances by the golden angle stand for equal areas
/// (Vogel 1979).
Eigen::Vector3f PointOf(const Disc& disc, int i) {
  const double radius_m = disc.radius_m * std::sqrt((i + 0.5) / kPointsPerDisc);
  const double angle_rad = i * kGoldenAngleRad;
  const Eigen::Vector3f u = disc.normal.unitOrthogonal();
  const Eigen::Vector3f v = disc.normal.cross(u);
  return disc.center + static_cast<float>(radius_m * std::cos(angle_rad)) * u +
         static_cast<float>(radius_m * std::sin(angle_rad)) * v;
}

}  // namespace

bool IsOver(const Disc& disc, const Eigen::Vector3f& point, float thickness_m) {
  const Eigen::Vector3f offset = point - disc.center;
  const float height_m = offset.dot(disc.normal);
  return std::abs(height_m) <= thickness_m &&
         (offset - height_m * disc.normal).squaredNorm() <= disc.radius_m * disc.radius_m;
}

DiscIndex::DiscIndex(std::vector<Disc> discs, float reach_m) : discs_(std::move(discs)) {
  for (std::size_t i = 0; i < discs_.size(); ++i) List(static_cast<std::uint32_t>(i), reach_m);
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.cell, a.disc) < std::tie(b.cell, b.disc);
  });
}

DiscIndex::Cell DiscIndex::CellOf(const Eigen::Vector3f& point) const {
  const auto index = [](float x) { return static_cast<std::int32_t>(std::floor(x / kCellM)); };
  return {index(point.x()), index(point.y()), index(point.z())};
}

void DiscIndex::List(std::uint32_t index, float reach_m) {
  const Disc& disc = discs_[index];
  const Eigen::Vector3f extent = Eigen::Vector3f::Constant(std::hypot(disc.radius_m, reach_m));
  const Cell min = CellOf(disc.center - extent);
  const Cell max = CellOf(disc.center + extent);
  // Cells further from the disc's plane than this have nothing within reach.
  const float max_height_m = reach_m + 0.5F * std::sqrt(3.0F) * kCellM;
  for (std::int32_t z = min[2]; z <= max[2]; ++z) {
    for (std::int32_t y = min[1]; y <= max[1]; ++y) {
      for (std::int32_t x = min[0]; x <= max[0]; ++x) {
        const Eigen::Vector3f corner = Eigen::Vector3i(x, y, z).cast<float>();
        const Eigen::Vector3f middle = (corner.array() + 0.5F).matrix() * kCellM;
        if (std::abs((middle - disc.center).dot(disc.normal)) > max_height_m) continue;
        entries_.push_back({{x, y, z}, index});
      }
    }
  }
}

std::pair<const DiscIndex::Entry*, const DiscIndex::Entry*> DiscIndex::EntriesAt(
    const Cell& cell) const {
  struct IsBefore {
    bool operator()(const Entry& entry, const Cell& c) const { return entry.cell < c; }
    bool operator()(const Cell& c, const Entry& entry) const { return c < entry.cell; }
  };
  const Entry* const all = entries_.data();
  return std::equal_range(all, all + entries_.size(), cell, IsBefore());
}

double UnionArea(const std::vector<Disc>& discs, float thickness_m) {
  const DiscIndex index(discs, thickness_m);
  double area_m2 = 0;
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    int num_uncovered = 0;
    for (int k = 0; k < kPointsPerDisc; ++k) {
      const Eigen::Vector3f point = PointOf(discs[i], k);
      const bool is_covered = index.AnyNear(point, [&](std::uint32_t other) {
        return other < i && IsOver(discs[other], point, thickness_m);
      });
      if (!is_covered) ++num_uncovered;
    }
    const double radius_m = discs[i].radius_m;
    area_m2 += M_PI * radius_m * radius_m * num_uncovered / kPointsPerDisc;
  }
  return area_m2;
}

}  // namespace posefusion
