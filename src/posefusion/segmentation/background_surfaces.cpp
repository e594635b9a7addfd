#include "posefusion/segmentation/background_surfaces.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "posefusion/segmentation/seed_distance.h"

namespace posefusion {
namespace {

constexpr int kReachCells = 10;     ///< a plane is made of cells so close together
constexpr int kScoreSamples = 400;  ///< points that a tried plane is scored with
constexpr int kMinCandidates = 50;

}  // namespace

BackgroundSurfaces::BackgroundSurfaces(const BackgroundSurfacesConfig& config) : config_(config) {}

void BackgroundSurfaces::Mark(CutProblem& problem) {
  if (!config_.enabled || problem.seeds.empty()) return;
  CollectCandidates(problem);
  const auto enough =
      static_cast<std::size_t>(config_.min_support * static_cast<double>(problem.region.area()));
  random_state_ = 1;
  for (int i = 0; i < config_.max_planes; ++i) {
    if (points_.size() < std::max<std::size_t>(enough, kMinCandidates)) return;
    Plane plane = BestPlane(problem);
    Refit(plane);
    if (static_cast<std::size_t>(CountOn(plane, 1)) < enough) return;
    TakeFrom(plane, problem);
    Spread(plane, problem);
  }
}

void BackgroundSurfaces::CollectCandidates(const CutProblem& problem) {
  points_.clear();
  places_.clear();
  const SeedDistance distance(problem.seeds);
  const auto far = static_cast<float>(config_.min_skeleton_distance_m);
  for (int y = 0; y < problem.region.height; ++y) {
    for (int x = 0; x < problem.region.width; ++x) {
      const Eigen::Vector3f point =
          problem.cells->PointAt(problem.region.x + x, problem.region.y + y);
      if (point.z() <= 0 || distance.IsWithin(point, far)) continue;
      points_.push_back(point);
      places_.emplace_back(x, y);
    }
  }
}

int BackgroundSurfaces::Random(int end) {
  random_state_ = random_state_ * 6364136223846793005ULL + 1442695040888963407ULL;  // Knuth, MMIX
  return static_cast<int>((random_state_ >> 33) % static_cast<std::uint64_t>(end));
}

/// Plane through a candidate and two cells near it.
bool BackgroundSurfaces::PlaneAround(const CutProblem& problem, int candidate, Plane& plane) {
  const cv::Point place = places_[static_cast<std::size_t>(candidate)];
  Eigen::Vector3f corners[3] = {points_[static_cast<std::size_t>(candidate)], {}, {}};
  for (int i = 1; i < 3; ++i) {
    const cv::Point other(place.x + Random(2 * kReachCells + 1) - kReachCells,
                          place.y + Random(2 * kReachCells + 1) - kReachCells);
    if (!cv::Rect({0, 0}, problem.region.size()).contains(other)) return false;
    corners[i] = problem.cells->PointAt(problem.region.x + other.x, problem.region.y + other.y);
    if (corners[i].z() <= 0) return false;
  }
  const Eigen::Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const float length = normal.norm();
  if (length < 1e-4F) return false;  // m^2: corners on a line
  plane.normal = normal / length;
  plane.offset_m = -plane.normal.dot(corners[0]);
  return true;
}

BackgroundSurfaces::Plane BackgroundSurfaces::BestPlane(const CutProblem& problem) {
  Plane best;
  int best_count = 0;
  const int step = std::max(1, static_cast<int>(points_.size()) / kScoreSamples);
  for (int i = 0; i < config_.num_samples; ++i) {
    Plane plane;
    if (!PlaneAround(problem, Random(static_cast<int>(points_.size())), plane)) continue;
    const int count = CountOn(plane, step);
    if (count > best_count) {
      best_count = count;
      best = plane;
    }
  }
  return best;
}

int BackgroundSurfaces::CountOn(const Plane& plane, int step) const {
  int count = 0;
  for (std::size_t i = 0; i < points_.size(); i += static_cast<std::size_t>(step)) {
    count += IsOn(plane, points_[i]) ? 1 : 0;
  }
  return count;
}

bool BackgroundSurfaces::IsOn(const Plane& plane, const Eigen::Vector3f& point) const {
  const float along_normal = plane.normal.dot(point);
  const float sigma = DepthSigma(noise_, point.z()) * std::abs(along_normal) / point.z();
  const float tolerance = std::max(static_cast<float>(config_.distance_m),
                                   static_cast<float>(config_.distance_sigmas) * sigma);
  return std::abs(along_normal + plane.offset_m) < tolerance;
}

/// Least squares over the points on the plane.
void BackgroundSurfaces::Refit(Plane& plane) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 0;
  for (const Eigen::Vector3f& point : points_) {
    if (!IsOn(plane, point)) continue;
    const Eigen::Vector3d p = point.cast<double>();
    sum += p;
    squares += p * p.transpose();
    ++count;
  }
  if (count < 3) return;
  const Eigen::Vector3d mean = sum / count;
  const Eigen::Matrix3d covariance = squares / count - mean * mean.transpose();
  const Eigen::Vector3d normal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
  plane.normal = normal.cast<float>();
  plane.offset_m = static_cast<float>(-normal.dot(mean));
}

/// Takes the candidates on the plane out of the list; the plane spreads from them.
void BackgroundSurfaces::TakeFrom(const Plane& plane, CutProblem& problem) {
  reached_.Resize(problem.region.width, problem.region.height);
  reached_.Fill(0);
  front_.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (IsOn(plane, points_[i])) {
      front_.push_back(places_[i]);
      reached_.at(places_[i].x, places_[i].y) = 1;
      continue;
    }
    points_[kept] = points_[i];
    places_[kept++] = places_[i];
  }
  points_.resize(kept);
  places_.resize(kept);
}

void BackgroundSurfaces::Spread(const Plane& plane, CutProblem& problem) {
  const cv::Point kSteps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  while (!front_.empty()) {
    const cv::Point cell = front_.back();
    front_.pop_back();
    CellState& state = problem.states.at(cell.x, cell.y);
    if (state == CellState::kFree) state = CellState::kBackground;
    for (const cv::Point& step : kSteps) {
      const cv::Point next = cell + step;
      if (!cv::Rect({0, 0}, problem.region.size()).contains(next)) continue;
      if (reached_.at(next.x, next.y) != 0) continue;
      const Eigen::Vector3f point =
          problem.cells->PointAt(problem.region.x + next.x, problem.region.y + next.y);
      if (point.z() <= 0 || !IsOn(plane, point)) continue;
      reached_.at(next.x, next.y) = 1;
      front_.push_back(next);
    }
  }
}

}  // namespace posefusion
