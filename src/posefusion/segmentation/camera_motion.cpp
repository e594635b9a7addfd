#include "posefusion/segmentation/camera_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "posefusion/image/depth_noise.h"

namespace posefusion {
namespace {

constexpr int kStep = 3;  ///< of so many cells in each direction one is looked at
constexpr int kFlowSteps = 5;
constexpr int kImageSteps = 5;
/// Deviation of the flow, cells, at the second step; the first one takes all of it for good.
constexpr double kFlowSigma = 1.5;
constexpr double kFlowSigmaShrinks = 0.7;  ///< with each step, down to ...
constexpr double kLeastFlowSigma = 0.3;
constexpr double kMaxFlowError = 4.7;         ///< cells from the flow that images may still pull
constexpr double kSharpGradient = 8;          ///< grey levels over two cells: half sharp
constexpr double kGreySigma = 6;              ///< grey levels
constexpr double kMaxPlaneDistance = 0.08;    ///< metres
constexpr double kLeastSurfaceSigma = 0.004;  ///< metres
constexpr double kMaxSlope = 0.1;             ///< of the depth, from a cell to those around it
constexpr int kNormalReach = 2;               ///< cells
constexpr double kCutoff = 4.685;             ///< sigmas: Tukey's biweight at 95 % efficiency
constexpr int kMinInliers = 100;
constexpr double kMinInlierShare = 0.3;
constexpr double kDamping = 1e-6;

double TukeyWeight(double sigmas) {
  const double ratio = sigmas / kCutoff;
  if (std::abs(ratio) >= 1) return 0;
  const double rest = 1 - ratio * ratio;
  return rest * rest;
}

double SharpnessOf(int gradient) {
  const double squared = static_cast<double>(gradient) * gradient;
  return squared / (squared + kSharpGradient * kSharpGradient);
}

/// Row of the Jacobian for a derivative by the moved point.
Vector6d ByMotion(const Eigen::Vector3d& by_point, const Eigen::Vector3d& p) {
  Vector6d J;
  J << by_point, p.cross(by_point);
  return J;
}

/// Normal of the surface around a cell; none at gaps and at the border.
std::optional<Eigen::Vector3d> NormalAt(const CellGrid& cells, const cv::Point& cell) {
  const cv::Rect inner(kNormalReach, kNormalReach, cells.width() - 2 * kNormalReach,
                       cells.height() - 2 * kNormalReach);
  if (!inner.contains(cell)) return std::nullopt;
  const double z = static_cast<double>(cells.DepthAt(cell.x, cell.y));
  const auto continues = [&](int x, int y) {
    const auto other = static_cast<double>(cells.DepthAt(x, y));
    return other > 0 && std::abs(other - z) < kMaxSlope * z;
  };
  if (!continues(cell.x - kNormalReach, cell.y) || !continues(cell.x + kNormalReach, cell.y) ||
      !continues(cell.x, cell.y - kNormalReach) || !continues(cell.x, cell.y + kNormalReach)) {
    return std::nullopt;
  }
  return cells.NormalAt(cell.x, cell.y, kNormalReach).cast<double>();
}

/// Bilinear value and gradient per cell.
struct Intensity {
  double value;
  double by_x;
  double by_y;
};

std::optional<Intensity> IntensityAt(const cv::Mat& grey, const Eigen::Vector2d& place) {
  const int x = static_cast<int>(std::floor(place.x()));
  const int y = static_cast<int>(std::floor(place.y()));
  if (x < 0 || y < 0 || x + 1 >= grey.cols || y + 1 >= grey.rows) return std::nullopt;
  const auto at = [&](int u, int v) { return static_cast<double>(grey.at<std::uint8_t>(v, u)); };
  const double right = place.x() - x;
  const double down = place.y() - y;
  const double upper = at(x + 1, y) - at(x, y);
  const double lower = at(x + 1, y + 1) - at(x, y + 1);
  const double top = at(x, y) + right * upper;
  const double bottom = at(x, y + 1) + right * lower;
  return Intensity{top + down * (bottom - top), upper + down * (lower - upper), bottom - top};
}

}  // namespace

void CameraMotion::System::Add(const Vector6d& J, double residual, double weight) {
  A.noalias() += weight * J * J.transpose();
  b.noalias() += weight * residual * J;
}

void CameraMotion::Collect(const CameraMotionTask& task) {
  samples_.clear();
  for (int y = 1; y < task.now.height() - 1; y += kStep) {
    const auto* moved = task.motion.ptr<cv::Vec2f>(y);
    const auto* grey = task.grey_now.ptr<std::uint8_t>(y);
    for (int x = 1; x < task.now.width() - 1; x += kStep) {
      if (task.now.DepthAt(x, y) <= 0) continue;
      const Eigen::Vector2d place(x + static_cast<double>(moved[x][0]),
                                  y + static_cast<double>(moved[x][1]));
      const auto cell = task.before.CellNear(place);
      if (!cell || task.before.DepthAt(cell->x, cell->y) <= 0) continue;
      if (IsPerson(task.people_before.person.at(cell->x, cell->y))) continue;
      const int down = task.grey_now.at<std::uint8_t>(y + 1, x);
      const int up = task.grey_now.at<std::uint8_t>(y - 1, x);
      samples_.push_back({task.now.PointAt(x, y).cast<double>(),
                          place,
                          {SharpnessOf(grey[x + 1] - grey[x - 1]), SharpnessOf(down - up)},
                          static_cast<double>(grey[x])});
    }
  }
}

template <class Add>
CameraMotion::System CameraMotion::Linearise(const CameraMotionTask& task,
                                             const Eigen::Isometry3d& T_before_now,
                                             const Add& add) const {
  System system;
  const double focal = 1 / task.before.size_at_1m();
  for (const Sample& sample : samples_) {
    const Eigen::Vector3d p = T_before_now * sample.p_now;
    if (p.z() <= 0) continue;
    const Eigen::Vector2d place = task.before.PlaceOf(p);
    add(sample, Moved{p, place, focal, (place - sample.place_before).norm()}, system);
  }
  return system;
}

CameraMotion::System CameraMotion::LineariseFlow(const CameraMotionTask& task,
                                                 const Eigen::Isometry3d& T_before_now,
                                                 double sigma_cells) const {
  return Linearise(task, T_before_now,
                   [&](const Sample& sample, const Moved& moved, System& system) {
                     AddFlow(sample, moved, sigma_cells, system);
                   });
}

CameraMotion::System CameraMotion::LineariseImages(const CameraMotionTask& task,
                                                   const Eigen::Isometry3d& T_before_now,
                                                   double grey_difference) const {
  return Linearise(task, T_before_now,
                   [&](const Sample& sample, const Moved& moved, System& system) {
                     if (moved.flow_error > kMaxFlowError) return;
                     ++system.num_inliers;
                     AddIntensity(task, sample, moved, grey_difference, system);
                     AddSurface(task, moved, system);
                   });
}

void CameraMotion::AddFlow(const Sample& sample, const Moved& moved, double sigma_cells,
                           System& system) {
  const double weight = TukeyWeight(moved.flow_error / sigma_cells) / (sigma_cells * sigma_cells);
  if (weight <= 0) return;
  ++system.num_inliers;
  const Eigen::Vector2d error = moved.place - sample.place_before;
  const double z = moved.p.z();
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Vector3d by_point = Eigen::Vector3d::Zero();
    by_point[axis] = moved.focal / z;
    by_point.z() = -moved.focal * moved.p[axis] / (z * z);
    system.Add(ByMotion(by_point, moved.p), error[axis], weight * sample.sharpness[axis]);
  }
}

void CameraMotion::AddIntensity(const CameraMotionTask& task, const Sample& sample,
                                const Moved& moved, double grey_difference, System& system) {
  const auto before = IntensityAt(task.grey_before, moved.place);
  if (!before) return;
  const double difference = before->value - sample.grey;
  const double residual = difference - grey_difference;
  const double weight = TukeyWeight(residual / kGreySigma) / (kGreySigma * kGreySigma);
  system.grey_difference += weight * difference;
  system.grey_weight += weight;
  const Eigen::Vector2d by_ray = moved.focal * Eigen::Vector2d(before->by_x, before->by_y);
  const double z = moved.p.z();
  const Eigen::Vector3d by_point(by_ray.x() / z, by_ray.y() / z,
                                 -by_ray.dot(moved.p.head<2>()) / (z * z));
  system.Add(ByMotion(by_point, moved.p), residual, weight);
}

void CameraMotion::AddSurface(const CameraMotionTask& task, const Moved& moved, System& system) {
  const auto cell = task.before.CellNear(moved.place);
  if (!cell) return;
  const auto normal = NormalAt(task.before, *cell);
  if (!normal) return;
  const Eigen::Vector3d on_surface = task.before.PointAt(cell->x, cell->y).cast<double>();
  const double distance = normal->dot(moved.p - on_surface);
  if (std::abs(distance) > kMaxPlaneDistance) return;
  const double noise = static_cast<double>(DepthSigma({}, static_cast<float>(moved.p.z())));
  const double sigma = std::max(kLeastSurfaceSigma, noise);
  system.Add(ByMotion(*normal, moved.p), distance, TukeyWeight(distance / sigma) / (sigma * sigma));
}

std::optional<Eigen::Isometry3d> CameraMotion::Estimate(const CameraMotionTask& task) {
  Collect(task);
  Eigen::Isometry3d T_before_now = Eigen::Isometry3d::Identity();
  double flow_sigma = static_cast<double>(task.now.width());
  double grey_difference = 0;
  for (int i = 0; i < kFlowSteps + kImageSteps; ++i) {
    System system = i < kFlowSteps ? LineariseFlow(task, T_before_now, flow_sigma)
                                   : LineariseImages(task, T_before_now, grey_difference);
    const double share = system.num_inliers / static_cast<double>(samples_.size());
    if (system.num_inliers < kMinInliers || share < kMinInlierShare) return std::nullopt;
    if (system.grey_weight > 0) grey_difference = system.grey_difference / system.grey_weight;
    flow_sigma = i == 0 ? kFlowSigma : std::max(kLeastFlowSigma, flow_sigma * kFlowSigmaShrinks);
    system.A.diagonal().array() += kDamping;
    const Vector6d step = system.A.ldlt().solve(-system.b);
    if (!step.allFinite()) return std::nullopt;
    T_before_now = Orthonormalized(ExpSE3(step) * T_before_now);
  }
  return T_before_now;
}

}  // namespace posefusion
