#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "posefusion/image/depth_noise.h"
#include "posefusion/segmentation/background_surfaces_config.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/seed_distance.h"

namespace posefusion {

/// Points p of the camera frame with normal * p + offset_m = 0.
struct Plane {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float offset_m = 0;
};

/// Finds large planes away from the people and follows them up to the people. Keeps its memory;
/// equal input gives equal results. Not thread-safe.
class BackgroundSurfaces {
 public:
  explicit BackgroundSurfaces(const BackgroundSurfacesConfig& config);

  /// `background` becomes the size of the cells, 1 where a cell lies on such a plane and is
  /// connected on it with cells far from every seed (on large planes: anywhere), 0 elsewhere.
  /// `known_people` (CV_8UC1 of the cells, not 0 = person; may be empty) counts like seeds.
  ///
  /// `planes` are the large ones of the frame before; they become those of this one. A table is
  /// still known when people hide most of it.
  void Find(const CellGrid& cells, const std::vector<BodyPoint>& seeds, const cv::Mat& known_people,
            std::vector<Plane>& planes, Grid<std::uint8_t>& background);

 private:
  struct Points {
    void Clear();
    void Add(const Eigen::Vector3f& point, const cv::Point& place);
    std::size_t size() const { return points.size(); }
    std::vector<Eigen::Vector3f> points;  ///< camera frame
    std::vector<cv::Point> places;        ///< cells of the same
  };

  /// Some of the points, to score tried planes with.
  struct Samples {
    std::array<std::vector<float>, 3> point;   ///< camera frame, by axis
    std::array<std::vector<float>, 3> normal;  ///< by axis
    std::vector<float> tolerance;              ///< per metre of the plane's distance
  };

  void ComputeNormals(const CellGrid& cells);
  void CollectCandidates(const CellGrid& cells, const std::vector<BodyPoint>& seeds,
                         const cv::Mat& known_people);
  Plane BestPlane(const CellGrid& cells);
  bool PlaneAround(const CellGrid& cells, int candidate, Plane& plane);
  void CollectSamples();
  float ScoreOf(const Plane& plane) const;
  double AreaOn(const Plane& plane, double cell_size_at_1m) const;
  void Refit(const Points& points, float slack_m, Plane& plane) const;
  bool IsOn(const Plane& plane, const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
            float slack_m = 0) const;
  bool Follow(double cell_size_at_1m, Plane& plane) const;
  void FollowPlanes(const CellGrid& cells, std::vector<Plane>& planes,
                    Grid<std::uint8_t>& background);
  void TakeFrom(const Plane& plane, const CellGrid& cells);
  void TakeAll(const Plane& plane, const CellGrid& cells, Grid<std::uint8_t>& background) const;
  void Spread(const Plane& plane, const CellGrid& cells, Grid<std::uint8_t>& background);
  int Random(int end);
  const Eigen::Vector3f& NormalOf(const Points& points, std::size_t i) const {
    return normals_.at(points.places[i].x, points.places[i].y);
  }

  const BackgroundSurfacesConfig config_;
  const float min_cosine_;
  const DepthNoiseConfig noise_;
  std::uint64_t random_state_ = 0;
  Points points_;                  ///< of cells far from every seed and on no plane yet
  Samples samples_;                ///< of points_
  Points all_points_;              ///< of all cells that are looked at
  Grid<Eigen::Vector3f> normals_;  ///< of all cells; zero where there is none
  std::vector<cv::Point> front_;   ///< cells that a plane has spread to
  Grid<std::uint8_t> near_;
  Grid<std::uint8_t> reached_;
};

}  // namespace posefusion
