#include "posefusion/segmentation/cell_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posefusion {
namespace {

constexpr float kFar = 9;           ///< metres: there is no such seed
constexpr float kNoPiece = -10;     ///< ln(m^2) on a plane and without depth
constexpr float kOutside = -1;      ///< metres inside, far from all unseen parts
constexpr float kPieceGap = 0.08F;  ///< metres of depth between cells of different pieces
constexpr float kThinShare = 0.6F;  ///< of r, below which a limb is thin
constexpr float kNotYet = std::numeric_limits<float>::infinity();

bool Found(const PersonSeeds& person, CocoJoint joint) { return person.found[joint]; }

}  // namespace

bool IsOnSurface(const Seed& seed, const CellGrid& cells, const Grid<std::uint8_t>& surfaces) {
  const auto cell = cells.CellAt(seed.pixel);
  return cell && surfaces.at(cell->x, cell->y) != 0;
}

void CellFeatureReader::Seeds::Clear() {
  distance.Clear();
  depth_m.clear();
  person.clear();
}

void CellFeatureReader::Seeds::Add(const Seed& seed, std::size_t number) {
  distance.Add(seed.OnBody());
  depth_m.push_back(seed.p_camera.z());
  person.push_back(number);
}

void CellFeatureReader::Open(const CellScene& scene) {
  scene_ = &scene;
  CollectSeeds(scene);
  MeasurePieces(scene);
}

void CellFeatureReader::CollectSeeds(const CellScene& scene) {
  for (Seeds& seeds : seeds_) seeds.Clear();
  min_depth_m_ = std::numeric_limits<float>::infinity();
  max_depth_m_ = 0;
  for (std::size_t i = 0; i < scene.people.size(); ++i) {
    for (const Seed& seed : scene.people[i].seeds) {
      if (!scene.cells.CellAt(seed.pixel)) continue;
      if (IsOnSurface(seed, scene.cells, scene.surfaces)) continue;
      const Thickness thickness = seed.radius_share >= 1           ? kThick
                                  : seed.radius_share < kThinShare ? kThin
                                                                   : kMedium;
      seeds_[thickness].Add(seed, i);
      min_depth_m_ = std::min(min_depth_m_, seed.p_camera.z());
      max_depth_m_ = std::max(max_depth_m_, seed.p_camera.z());
    }
  }
}

/// Area of every connected piece of what lies on no plane.
void CellFeatureReader::MeasurePieces(const CellScene& scene) {
  piece_area_.Resize(scene.cells.width(), scene.cells.height());
  for (int y = 0; y < scene.cells.height(); ++y) {
    for (int x = 0; x < scene.cells.width(); ++x) {
      const bool is_in_piece = scene.cells.DepthAt(x, y) > 0 && scene.surfaces.at(x, y) == 0;
      piece_area_.at(x, y) = is_in_piece ? kNotYet : kNoPiece;
    }
  }
  for (int y = 0; y < scene.cells.height(); ++y) {
    for (int x = 0; x < scene.cells.width(); ++x) {
      if (piece_area_.at(x, y) != kNotYet) continue;
      const float log_area = std::log(FillPiece(scene, {x, y}));
      for (const cv::Point& cell : piece_) piece_area_.at(cell.x, cell.y) = log_area;
    }
  }
}

/// Finds the cells that are connected with `first`; returns their area in m^2 as if they faced the
/// camera.
float CellFeatureReader::FillPiece(const CellScene& scene, const cv::Point& first) {
  const cv::Rect inside({0, 0}, scene.cells.size());
  const auto edge_at_1m = static_cast<float>(scene.cells.size_at_1m());
  float area = 0;
  piece_.assign(1, first);
  piece_area_.at(first.x, first.y) = kNoPiece;
  for (std::size_t i = 0; i < piece_.size(); ++i) {
    const cv::Point cell = piece_[i];
    const float z = scene.cells.DepthAt(cell.x, cell.y);
    area += z * z * edge_at_1m * edge_at_1m;
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
      for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
        if (!inside.contains(cv::Point(x, y)) || piece_area_.at(x, y) != kNotYet) continue;
        if (std::abs(scene.cells.DepthAt(x, y) - z) > kPieceGap) continue;
        piece_area_.at(x, y) = kNoPiece;
        piece_.emplace_back(x, y);
      }
    }
  }
  return area;
}

bool CellFeatureReader::Read(const cv::Point& cell, CellFeatures& features) {
  const float z = scene_->cells.DepthAt(cell.x, cell.y);
  if (z <= 0 || z < min_depth_m_ - kReach || z > max_depth_m_ + kReach) return false;
  const Eigen::Vector3f p = scene_->cells.PointAt(cell.x, cell.y);
  Nearest nearest;
  ReadDistances(p, features, nearest);
  if (nearest.seeds == nullptr || nearest.squared > kReach * kReach) return false;
  features[kSeedDistance] = std::sqrt(nearest.squared);
  features[kBehindSeed] = z - nearest.seeds->depth_m[nearest.index];
  features[kCellDepth] = z;
  features[kOnSurface] = scene_->surfaces.at(cell.x, cell.y) != 0 ? 1 : 0;
  features[kColourRatio] = 0;
  if (scene_->people_colours != nullptr) {
    features[kColourRatio] = scene_->people_colours->LogRatio(scene_->colours.at<cv::Vec3b>(cell));
  }
  features[kPieceArea] = piece_area_.at(cell.x, cell.y);
  ReadUnseenParts(p, features);
  const std::size_t person = nearest.seeds->person[nearest.index];
  features[kBehindBody] = z - scene_->people[person].body_depth_m;
  ReadPerson(person, features);
  return true;
}

void CellFeatureReader::ReadDistances(const Eigen::Vector3f& p, CellFeatures& features,
                                      Nearest& nearest) const {
  constexpr CellFeature kFeatureOf[] = {kThickDistance, kMediumDistance, kThinDistance};
  nearest.squared = kFar * kFar;
  float shared = kFar * kFar;
  for (int thickness = 0; thickness < kNumThicknesses; ++thickness) {
    const Seeds& seeds = seeds_[static_cast<std::size_t>(thickness)];
    const SeedDistance::Squares squares = seeds.distance.To(p);
    const float best = std::min(squares.distance, kFar * kFar);
    shared = std::min(shared, squares.in_shares);
    features[kFeatureOf[thickness]] = std::sqrt(best);
    if (best < nearest.squared) nearest = {best, &seeds, seeds.distance.Nearest(p, best)};
  }
  features[kSeedDistanceShared] = std::sqrt(shared);
}

void CellFeatureReader::ReadUnseenParts(const Eigen::Vector3f& p, CellFeatures& features) const {
  features[kInUnseenPart] = kOutside;
  features[kLeavesImage] = 0;
  for (const PersonSeeds& person : scene_->people) {
    for (const UnseenPart& part : person.unseen_parts) {
      const float inside_m = part.radius_m - (part.p_camera - p).norm();
      features[kInUnseenPart] = std::max(features[kInUnseenPart], inside_m);
      if (inside_m > 0 && part.leaves_image) features[kLeavesImage] = 1;
    }
  }
}

void CellFeatureReader::ReadPerson(std::size_t number, CellFeatures& features) const {
  const PersonSeeds& person = scene_->people[number];
  const auto flag = [](bool value) { return value ? 1.0F : 0.0F; };
  features[kNumJoints] = static_cast<float>(person.num_joints);
  features[kNumCertainJoints] = static_cast<float>(person.num_certain_joints);
  features[kHasKnee] = flag(Found(person, kRightKnee) || Found(person, kLeftKnee));
  features[kHasAnkle] = flag(Found(person, kRightAnkle) || Found(person, kLeftAnkle));
  features[kHasWrists] = flag(Found(person, kRightWrist) && Found(person, kLeftWrist));
  features[kHasHip] = flag(Found(person, kRightHip) || Found(person, kLeftHip));
}

}  // namespace posefusion
