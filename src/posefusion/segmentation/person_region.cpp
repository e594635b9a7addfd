#include "posefusion/segmentation/person_region.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

/// How far the person may reach beyond its seeds, pixels.
struct Margins {
  float side = 0;
  float up = 0;
  float down = 0;
};

bool HasAny(const PersonSeeds& person, std::initializer_list<CocoJoint> joints) {
  return std::any_of(joints.begin(), joints.end(), [&](CocoJoint j) { return person.found[j]; });
}

Margins MarginsOf(const PersonSeeds& person, const CameraModel& camera,
                  const PersonRegionConfig& config) {
  const float px_per_m = static_cast<float>(camera.fx) / person.body_depth_m;
  const float margin = static_cast<float>(config.margin_m) * px_per_m;
  const float missing = static_cast<float>(config.missing_part_m) * px_per_m;
  Margins margins{margin, margin, margin};
  if (!HasAny(person, {kNose, kRightEye, kLeftEye, kRightEar, kLeftEar})) margins.up += missing;
  if (!HasAny(person, {kRightAnkle, kLeftAnkle})) margins.down += missing;
  if (!HasAny(person, {kRightKnee, kLeftKnee})) margins.down += missing;
  return margins;
}

}  // namespace

PersonRegion RegionOf(const PersonSeeds& person, const CellGrid& cells, const CameraModel& camera,
                      const PersonRegionConfig& config) {
  PersonRegion region;
  if (person.seeds.empty()) return region;
  const Margins margins = MarginsOf(person, camera, config);
  cv::Point2f low = person.seeds.front().pixel;
  cv::Point2f high = low;
  region.min_depth_m = region.max_depth_m = person.seeds.front().p_camera.z();
  for (const Seed& seed : person.seeds) {
    low = {std::min(low.x, seed.pixel.x), std::min(low.y, seed.pixel.y)};
    high = {std::max(high.x, seed.pixel.x), std::max(high.y, seed.pixel.y)};
    region.min_depth_m = std::min(region.min_depth_m, seed.p_camera.z());
    region.max_depth_m = std::max(region.max_depth_m, seed.p_camera.z());
  }
  region.min_depth_m -= static_cast<float>(config.depth_before_m);
  region.max_depth_m += static_cast<float>(config.depth_behind_m);
  const auto to_cell = [&](float pixel) {
    return static_cast<int>(std::floor(pixel / static_cast<float>(cells.size_px())));
  };
  const cv::Point first(to_cell(low.x - margins.side), to_cell(low.y - margins.up));
  const cv::Point last(to_cell(high.x + margins.side), to_cell(high.y + margins.down));
  region.cells = cv::Rect(first, last + cv::Point(1, 1)) & cv::Rect({0, 0}, cells.size());
  return region;
}

}  // namespace posefusion
