#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "posefusion/image/depth_noise.h"
#include "posefusion/segmentation/background_surfaces_config.h"
#include "posefusion/segmentation/cell_grid.h"

namespace posefusion {

/// Finds large planes away from the people and follows them up to the people. Keeps its memory;
/// equal input gives equal results. Not thread-safe.
class BackgroundSurfaces {
 public:
  explicit BackgroundSurfaces(const BackgroundSurfacesConfig& config);

  /// `background` becomes the size of the cells, 1 where a cell lies on such a plane and is
  /// connected on it with cells far from every seed (on large planes: anywhere), 0 elsewhere.
  void Find(const CellGrid& cells, const std::vector<Eigen::Vector3f>& seeds,
            Grid<std::uint8_t>& background);

 private:
  struct Plane {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    float offset_m = 0;  ///< normal * point + offset = 0
  };

  void ComputeNormals(const CellGrid& cells);
  void CollectCandidates(const CellGrid& cells, const std::vector<Eigen::Vector3f>& seeds);
  Plane BestPlane(const CellGrid& cells);
  bool PlaneAround(const CellGrid& cells, int candidate, Plane& plane);
  float ScoreOf(const Plane& plane, std::size_t step) const;
  double AreaOn(const Plane& plane, double cell_size_at_1m) const;
  void Refit(Plane& plane) const;
  bool IsOn(const Plane& plane, const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;
  void TakeFrom(const Plane& plane, const CellGrid& cells);
  void TakeAll(const Plane& plane, const CellGrid& cells, Grid<std::uint8_t>& background) const;
  void Spread(const Plane& plane, const CellGrid& cells, Grid<std::uint8_t>& background);
  int Random(int end);
  const Eigen::Vector3f& NormalOf(std::size_t candidate) const {
    return normals_.at(places_[candidate].x, places_[candidate].y);
  }

  const BackgroundSurfacesConfig config_;
  const float min_cosine_;
  const DepthNoiseConfig noise_;
  std::uint64_t random_state_ = 0;
  std::vector<Eigen::Vector3f> points_;  ///< of cells far from every seed
  Grid<Eigen::Vector3f> normals_;        ///< of all cells; zero where there is none
  std::vector<cv::Point> places_;        ///< of the same
  std::vector<cv::Point> front_;         ///< cells that a plane has spread to
  Grid<std::uint8_t> near_;
  Grid<std::uint8_t> reached_;
};

}  // namespace posefusion
