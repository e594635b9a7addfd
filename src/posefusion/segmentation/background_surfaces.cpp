#include "posefusion/segmentation/background_surfaces.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace posefusion {
namespace {

/// What is known of cells; most are not looked at.
constexpr std::uint8_t kUnknown = 0;
constexpr std::uint8_t kNearSeeds = 1;
constexpr std::uint8_t kFarFromSeeds = 2;

constexpr int kSparse = 2;              ///< of so many cells in each direction one is looked at
constexpr int kNormalReach = 2;         ///< cells
constexpr int kReachCells = 10;         ///< a plane is made of cells so close together
constexpr std::size_t kLanes = 4;       ///< samples are looked at so many at once
constexpr int kScoreSamples = 400;      ///< points that a tried plane is scored with
constexpr std::size_t kMinPoints = 50;  ///< of a plane
/// From frame to frame a plane moves by no more, metres and cosine of the turn.
constexpr float kPlaneStep = 0.05F;
constexpr float kPlaneTurn = 0.998F;
constexpr double kRemembered = 0.35;     ///< m^2: no body has such a flat place
constexpr double kLeastFollowed = 0.01;  ///< m^2 away from people that a plane still has
constexpr float kMinCosine = 0.1F;       ///< flatter views say little of an area

}  // namespace

BackgroundSurfaces::BackgroundSurfaces(const BackgroundSurfacesConfig& config)
    : config_(config), min_cosine_(static_cast<float>(std::cos(config.max_angle_rad))) {}

void BackgroundSurfaces::Find(const CellGrid& cells, const std::vector<BodyPoint>& seeds,
                              const cv::Mat& known_people, std::vector<Plane>& planes,
                              Grid<std::uint8_t>& background) {
  background.Resize(cells.width(), cells.height());
  background.Fill(0);
  if (!config_.enabled || seeds.empty()) {
    planes.clear();
    return;
  }
  ComputeNormals(cells);
  CollectCandidates(cells, seeds, known_people);
  FollowPlanes(cells, planes, background);
  random_state_ = 1;
  for (int i = 0; i < config_.max_planes && points_.size() >= kMinPoints; ++i) {
    Plane plane = BestPlane(cells);
    Refit(points_, 0, plane);
    const double area_m2 = AreaOn(plane, kSparse * cells.size_at_1m());
    TakeFrom(plane, cells);
    if (area_m2 >= config_.min_broken_area_m2) {
      TakeAll(plane, cells, background);
      if (area_m2 >= kRemembered) planes.push_back(plane);
    } else if (area_m2 >= config_.min_area_m2) {
      Spread(plane, cells, background);
    }
  }
}

/// Finds a plane of the frame before again. False when it is hidden, out of the view or has moved
/// by more than a camera moves it.
bool BackgroundSurfaces::Follow(double cell_size_at_1m, Plane& plane) const {
  const Plane before = plane;
  for (const float slack_m : {kPlaneStep, kPlaneStep / 2, 0.0F}) {
    Refit(all_points_, slack_m, plane);
    if (plane.normal.dot(before.normal) < 0) {
      plane.normal = -plane.normal;
      plane.offset_m = -plane.offset_m;
    }
  }
  return plane.normal.dot(before.normal) > kPlaneTurn &&
         std::abs(plane.offset_m - before.offset_m) < 2 * kPlaneStep &&
         AreaOn(plane, cell_size_at_1m) > kLeastFollowed;
}

void BackgroundSurfaces::FollowPlanes(const CellGrid& cells, std::vector<Plane>& planes,
                                      Grid<std::uint8_t>& background) {
  std::vector<Plane> followed;
  for (Plane plane : planes) {
    if (!Follow(kSparse * cells.size_at_1m(), plane)) continue;
    TakeFrom(plane, cells);
    TakeAll(plane, cells, background);
    followed.push_back(plane);
  }
  planes.swap(followed);
}

void BackgroundSurfaces::Points::Clear() {
  points.clear();
  places.clear();
}

void BackgroundSurfaces::Points::Add(const Eigen::Vector3f& point, const cv::Point& place) {
  points.push_back(point);
  places.push_back(place);
}

/// From the cells kNormalReach to each side; none over a gap in depth.
void BackgroundSurfaces::ComputeNormals(const CellGrid& cells) {
  normals_.Resize(cells.width(), cells.height());
  normals_.Fill(Eigen::Vector3f::Zero());
  for (int y = kNormalReach; y < cells.height() - kNormalReach; ++y) {
    for (int x = kNormalReach; x < cells.width() - kNormalReach; ++x) {
      const float left = cells.DepthAt(x - kNormalReach, y);
      const float right = cells.DepthAt(x + kNormalReach, y);
      const float up = cells.DepthAt(x, y - kNormalReach);
      const float down = cells.DepthAt(x, y + kNormalReach);
      if (left <= 0 || right <= 0 || up <= 0 || down <= 0) continue;
      normals_.at(x, y) = cells.NormalAt(x, y, kNormalReach);
    }
  }
}

void BackgroundSurfaces::CollectCandidates(const CellGrid& cells,
                                           const std::vector<BodyPoint>& seeds,
                                           const cv::Mat& known_people) {
  points_.Clear();
  all_points_.Clear();
  near_.Resize(cells.width(), cells.height());
  near_.Fill(kUnknown);
  const SeedDistance distance(seeds);
  const auto far = static_cast<float>(config_.min_skeleton_distance_m);
  for (int y = 0; y < cells.height(); y += kSparse) {
    for (int x = 0; x < cells.width(); x += kSparse) {
      const Eigen::Vector3f point = cells.PointAt(x, y);
      if (point.z() <= 0) continue;
      const bool is_known = !known_people.empty() && known_people.at<std::uint8_t>(y, x) != 0;
      near_.at(x, y) = is_known || distance.IsWithinShare(point, far) ? kNearSeeds : kFarFromSeeds;
      all_points_.Add(point, {x, y});
      if (near_.at(x, y) == kFarFromSeeds) points_.Add(point, {x, y});
    }
  }
}

int BackgroundSurfaces::Random(int end) {
  random_state_ = random_state_ * 6364136223846793005ULL + 1442695040888963407ULL;  // Knuth, MMIX
  return static_cast<int>((random_state_ >> 33) % static_cast<std::uint64_t>(end));
}

/// Plane through a candidate and two cells near it.
bool BackgroundSurfaces::PlaneAround(const CellGrid& cells, int candidate, Plane& plane) {
  const cv::Point place = points_.places[static_cast<std::size_t>(candidate)];
  Eigen::Vector3f corners[3] = {points_.points[static_cast<std::size_t>(candidate)], {}, {}};
  for (int i = 1; i < 3; ++i) {
    const cv::Point other(place.x + Random(2 * kReachCells + 1) - kReachCells,
                          place.y + Random(2 * kReachCells + 1) - kReachCells);
    if (!cv::Rect({0, 0}, cells.size()).contains(other)) return false;
    corners[i] = cells.PointAt(other.x, other.y);
    if (corners[i].z() <= 0) return false;
  }
  const Eigen::Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const float length = normal.norm();
  if (length < 1e-4F) return false;  // m^2: corners on a line
  plane.normal = normal / length;
  plane.offset_m = -plane.normal.dot(corners[0]);
  return true;
}

void BackgroundSurfaces::CollectSamples() {
  const auto clear = [](std::vector<float>& values) { values.clear(); };
  std::for_each(samples_.point.begin(), samples_.point.end(), clear);
  std::for_each(samples_.normal.begin(), samples_.normal.end(), clear);
  samples_.tolerance.clear();
  const auto add = [&](const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      samples_.point[axis].push_back(point[static_cast<int>(axis)]);
      samples_.normal[axis].push_back(normal[static_cast<int>(axis)]);
    }
    samples_.tolerance.push_back(static_cast<float>(config_.distance_sigmas) *
                                 DepthSigma(noise_, point.z()) / point.z());
  };
  const std::size_t step = std::max<std::size_t>(1, points_.size() / kScoreSamples);
  for (std::size_t i = 0; i < points_.size(); i += step) {
    add(points_.points[i], NormalOf(points_, i));
  }
  while (samples_.tolerance.size() % kLanes != 0) {
    add(Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Zero());  // on no plane
  }
}

Plane BackgroundSurfaces::BestPlane(const CellGrid& cells) {
  Plane best;
  float best_score = 0;
  CollectSamples();
  for (int i = 0; i < config_.num_samples; ++i) {
    Plane plane;
    if (!PlaneAround(cells, Random(static_cast<int>(points_.size())), plane)) continue;
    const float score = ScoreOf(plane);
    if (score > best_score) {
      best_score = score;
      best = plane;
    }
  }
  return best;
}

/// Grows with the area on the plane: a cell covers more where it is farther.
float BackgroundSurfaces::ScoreOf(const Plane& plane) const {
  const auto along = [&](const std::array<std::vector<float>, 3>& vectors, std::size_t i) {
    return plane.normal.x() * vectors[0][i] + plane.normal.y() * vectors[1][i] +
           plane.normal.z() * vectors[2][i];
  };
  const auto least = static_cast<float>(config_.distance_m);
  std::array<float, kLanes> scores{};
  for (std::size_t i = 0; i < samples_.tolerance.size(); i += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float cosine = std::abs(along(samples_.normal, i + l));
      const float along_normal = along(samples_.point, i + l);
      const float noise = samples_.tolerance[i + l] * std::abs(along_normal);
      const float tolerance = noise > least ? noise : least;
      const float distance = std::abs(along_normal + plane.offset_m);
      const float z = samples_.point[2][i + l];
      const float area = cosine >= min_cosine_ ? z * z : 0;
      scores[l] += distance < tolerance ? area : 0;
    }
  }
  return std::accumulate(scores.begin(), scores.end(), 0.0F);
}

/// Area of the candidates on the plane, m^2; 0 when they are too few.
double BackgroundSurfaces::AreaOn(const Plane& plane, double cell_size_at_1m) const {
  double area = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!IsOn(plane, points_.points[i], NormalOf(points_, i))) continue;
    const Eigen::Vector3f& point = points_.points[i];
    const double edge = cell_size_at_1m * static_cast<double>(point.z());
    const float cosine = std::abs(plane.normal.dot(point)) / point.norm();
    area += edge * edge / static_cast<double>(std::max(cosine, kMinCosine));
    ++count;
  }
  return count < kMinPoints ? 0 : area;
}

bool BackgroundSurfaces::IsOn(const Plane& plane, const Eigen::Vector3f& point,
                              const Eigen::Vector3f& normal, float slack_m) const {
  if (std::abs(plane.normal.dot(normal)) < min_cosine_) return false;
  const float along_normal = plane.normal.dot(point);
  const float sigma = DepthSigma(noise_, point.z()) * std::abs(along_normal) / point.z();
  const float tolerance = std::max(static_cast<float>(config_.distance_m),
                                   static_cast<float>(config_.distance_sigmas) * sigma);
  return std::abs(along_normal + plane.offset_m) < tolerance + slack_m;
}

/// Least squares over the points on the plane.
void BackgroundSurfaces::Refit(const Points& points, float slack_m, Plane& plane) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!IsOn(plane, points.points[i], NormalOf(points, i), slack_m)) continue;
    const Eigen::Vector3d p = points.points[i].cast<double>();
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
void BackgroundSurfaces::TakeFrom(const Plane& plane, const CellGrid& cells) {
  reached_.Resize(cells.width(), cells.height());
  reached_.Fill(0);
  front_.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (IsOn(plane, points_.points[i], NormalOf(points_, i))) {
      front_.push_back(points_.places[i]);
      reached_.at(points_.places[i].x, points_.places[i].y) = 1;
      continue;
    }
    points_.points[kept] = points_.points[i];
    points_.places[kept++] = points_.places[i];
  }
  points_.points.resize(kept);
  points_.places.resize(kept);
}

/// Every cell on the plane: arms on a table cut parts of it off.
void BackgroundSurfaces::TakeAll(const Plane& plane, const CellGrid& cells,
                                 Grid<std::uint8_t>& background) const {
  for (int y = 0; y < cells.height(); ++y) {
    for (int x = 0; x < cells.width(); ++x) {
      const Eigen::Vector3f point = cells.PointAt(x, y);
      if (point.z() > 0 && IsOn(plane, point, normals_.at(x, y))) background.at(x, y) = 1;
    }
  }
}

/// A body close to the camera has flat places too; they lie around its seeds.
void BackgroundSurfaces::Spread(const Plane& plane, const CellGrid& cells,
                                Grid<std::uint8_t>& background) {
  const cv::Point kSteps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  std::size_t num_near = 0;
  std::size_t num_far = 0;
  for (std::size_t i = 0; i < front_.size(); ++i) {
    const cv::Point cell = front_[i];
    num_near += near_.at(cell.x, cell.y) == kNearSeeds ? 1 : 0;
    num_far += near_.at(cell.x, cell.y) == kFarFromSeeds ? 1 : 0;
    for (const cv::Point& step : kSteps) {
      const cv::Point next = cell + step;
      if (!cv::Rect({0, 0}, cells.size()).contains(next)) continue;
      if (reached_.at(next.x, next.y) != 0) continue;
      const Eigen::Vector3f point = cells.PointAt(next.x, next.y);
      if (point.z() <= 0 || !IsOn(plane, point, normals_.at(next.x, next.y))) continue;
      reached_.at(next.x, next.y) = 1;
      front_.push_back(next);
    }
  }
  const double near_share = static_cast<double>(num_near) /
                            static_cast<double>(std::max<std::size_t>(1, num_near + num_far));
  if (near_share > config_.max_near_share) return;
  for (const cv::Point& cell : front_) background.at(cell.x, cell.y) = 1;
}

}  // namespace posefusion
