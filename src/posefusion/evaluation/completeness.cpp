#include "posefusion/evaluation/completeness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace posefusion {
namespace {

constexpr int kGrain = 1024;
constexpr double kRandomRange = 4294967296.0;  ///< of std::mt19937

double TriangleArea(const TriangleMesh& mesh, const Eigen::Vector3i& triangle) {
  const auto vertex = [&](int i) -> Eigen::Vector3d {
    return mesh.vertices[static_cast<std::size_t>(triangle[i])].cast<double>();
  };
  return 0.5 * (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).norm();
}

/// A point that lies anywhere in the triangle with the same probability, for u and v in [0, 1).
Eigen::Vector3f PointInTriangle(const TriangleMesh& mesh, const Eigen::Vector3i& triangle, double u,
                                double v) {
  const auto vertex = [&](int i) -> Eigen::Vector3d {
    return mesh.vertices[static_cast<std::size_t>(triangle[i])].cast<double>();
  };
  const double root = std::sqrt(u);
  return ((1 - root) * vertex(0) + root * (1 - v) * vertex(1) + root * v * vertex(2)).cast<float>();
}

bool IsInImage(const CameraModel& camera, const Eigen::Vector3d& p_camera) {
  if (p_camera.z() <= 0) return false;
  const Eigen::Vector2d pixel = camera.Project(p_camera);
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= camera.width - 0.5 &&
         pixel.y() <= camera.height - 0.5;
}

bool IsSeen(const Eigen::Vector3f& point, const MeshIndex& mesh, const Views& views,
            const std::vector<Eigen::Isometry3d>& T_camera_map) {
  const Eigen::Vector3d p_map = point.cast<double>();
  for (std::size_t i = 0; i < T_camera_map.size(); ++i) {
    const Eigen::Vector3d p_camera = T_camera_map[i] * p_map;
    if (p_camera.squaredNorm() > views.max_distance_m * views.max_distance_m) continue;
    if (!IsInImage(views.camera, p_camera)) continue;
    if (!mesh.IsHidden(views.T_map_camera[i].translation().cast<float>(), point)) return true;
  }
  return false;
}

/// The answer for each point: 0 or 1.
std::vector<char> Ask(const std::vector<Eigen::Vector3f>& points, const ParallelRunner& runner,
                      const std::function<bool(const Eigen::Vector3f&)>& question) {
  std::vector<char> answers(points.size());
  runner.ForEachRange(static_cast<int>(points.size()), kGrain, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      answers[i] = question(points[i]) ? 1 : 0;
    }
  });
  return answers;
}

}  // namespace

std::vector<Eigen::Vector3f> SampleSurface(const TriangleMesh& mesh, double samples_per_m2,
                                           int seed) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  const auto next = [&] { return static_cast<double>(random()) / kRandomRange; };
  std::vector<Eigen::Vector3f> points;
  double area_so_far_m2 = 0;
  // The k-th point lies somewhere in the k-th of equal pieces of the area, in triangle order.
  double next_area_m2 = next() / samples_per_m2;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    area_so_far_m2 += TriangleArea(mesh, triangle);
    while (next_area_m2 < area_so_far_m2) {
      const double u = next();
      points.push_back(PointInTriangle(mesh, triangle, u, next()));
      next_area_m2 = (static_cast<double>(points.size()) + next()) / samples_per_m2;
    }
  }
  return points;
}

std::vector<Eigen::Vector3f> SeenPoints(const std::vector<Eigen::Vector3f>& points,
                                        const MeshIndex& mesh, const Views& views,
                                        const ParallelRunner& runner) {
  std::vector<Eigen::Isometry3d> T_camera_map;
  for (const Eigen::Isometry3d& T_map_camera : views.T_map_camera) {
    T_camera_map.push_back(T_map_camera.inverse());
  }
  const std::vector<char> is_seen = Ask(points, runner, [&](const Eigen::Vector3f& point) {
    return IsSeen(point, mesh, views, T_camera_map);
  });
  std::vector<Eigen::Vector3f> seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_seen[i] != 0) seen.push_back(points[i]);
  }
  return seen;
}

int CountCovered(const std::vector<Eigen::Vector3f>& points, const std::vector<Disc>& discs,
                 double distance_m, const ParallelRunner& runner) {
  const auto reach_m = static_cast<float>(distance_m);
  const DiscIndex index(discs, reach_m);
  const std::vector<char> is_covered = Ask(points, runner, [&](const Eigen::Vector3f& point) {
    return index.AnyNear(point, [&](std::uint32_t i) {
      const Disc& disc = index.discs()[i];
      return (point - disc.center).norm() <= reach_m || IsOver(disc, point, reach_m);
    });
  });
  return std::accumulate(is_covered.begin(), is_covered.end(), 0);
}

}  // namespace posefusion
