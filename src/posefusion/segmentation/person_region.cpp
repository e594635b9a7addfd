#include "posefusion/segmentation/person_region.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

/// How far the person may reach beyond its seeds.
struct Margins {
  cv::Point2f low;     ///< pixels to the left and up
  cv::Point2f high;    ///< pixels to the right and down
  float nearer_m = 0;  ///< towards the camera
  float farther_m = 0;
};

bool HasAny(const PersonSeeds& person, std::initializer_list<CocoJoint> joints) {
  return std::any_of(joints.begin(), joints.end(), [&](CocoJoint j) { return person.found[j]; });
}

/// Something of the body goes on by this vector, metres in the camera frame.
void Reach(const Eigen::Vector3f& part_m, float px_per_m, Margins& margins) {
  const cv::Point2f part_px(part_m.x() * px_per_m, part_m.y() * px_per_m);
  margins.low += cv::Point2f(std::max(-part_px.x, 0.0F), std::max(-part_px.y, 0.0F));
  margins.high += cv::Point2f(std::max(part_px.x, 0.0F), std::max(part_px.y, 0.0F));
  margins.nearer_m += std::max(-part_m.z(), 0.0F);
  margins.farther_m += std::max(part_m.z(), 0.0F);
}

Margins MarginsOf(const PersonSeeds& person, const CameraModel& camera,
                  const PersonRegionConfig& config, const Eigen::Vector3f& down) {
  const float px_per_m = static_cast<float>(camera.fx) / person.body_depth_m;
  const float margin = static_cast<float>(config.margin_m) * px_per_m;
  const Eigen::Vector3f missing_m = static_cast<float>(config.missing_part_m) * down;
  Margins margins{{margin, margin},
                  {margin, margin},
                  static_cast<float>(config.depth_before_m),
                  static_cast<float>(config.depth_behind_m)};
  if (!HasAny(person, {kNose, kRightEye, kLeftEye, kRightEar, kLeftEar})) {
    Reach(-missing_m, px_per_m, margins);
  }
  if (!HasAny(person, {kRightAnkle, kLeftAnkle})) Reach(missing_m, px_per_m, margins);
  if (!HasAny(person, {kRightKnee, kLeftKnee})) Reach(missing_m, px_per_m, margins);
  return margins;
}

}  // namespace

PersonRegion RegionOf(const PersonSeeds& person, const CellGrid& cells, const CameraModel& camera,
                      const PersonRegionConfig& config,
                      const std::optional<Eigen::Vector3f>& gravity) {
  PersonRegion region;
  if (person.seeds.empty()) return region;
  const Margins margins =
      MarginsOf(person, camera, config, gravity.value_or(Eigen::Vector3f::UnitY()));
  cv::Point2f low = person.seeds.front().pixel;
  cv::Point2f high = low;
  region.min_depth_m = region.max_depth_m = person.seeds.front().p_camera.z();
  for (const Seed& seed : person.seeds) {
    low = {std::min(low.x, seed.pixel.x), std::min(low.y, seed.pixel.y)};
    high = {std::max(high.x, seed.pixel.x), std::max(high.y, seed.pixel.y)};
    region.min_depth_m = std::min(region.min_depth_m, seed.p_camera.z());
    region.max_depth_m = std::max(region.max_depth_m, seed.p_camera.z());
  }
  region.min_depth_m -= margins.nearer_m;
  region.max_depth_m += margins.farther_m;
  const auto to_cell = [&](float pixel) {
    return static_cast<int>(std::floor(pixel / static_cast<float>(cells.size_px())));
  };
  const cv::Point first(to_cell(low.x - margins.low.x), to_cell(low.y - margins.low.y));
  const cv::Point last(to_cell(high.x + margins.high.x), to_cell(high.y + margins.high.y));
  region.cells = cv::Rect(first, last + cv::Point(1, 1)) & cv::Rect({0, 0}, cells.size());
  return region;
}

}  // namespace posefusion
