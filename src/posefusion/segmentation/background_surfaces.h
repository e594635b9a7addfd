#pragma once

#include "posefusion/image/depth_noise.h"
#include "posefusion/segmentation/background_surfaces_config.h"
#include "posefusion/segmentation/min_cut.h"

namespace posefusion {

/// Finds large planes around a person and follows them up to the person. Keeps its memory; equal
/// problems give equal results. Not thread-safe.
class BackgroundSurfaces {
 public:
  explicit BackgroundSurfaces(const BackgroundSurfacesConfig& config);

  /// Sets free cells of the problem that lie on such a plane, and are connected on it with cells
  /// far from every seed, to kBackground. Cells outside the person's range of depth count for
  /// finding planes.
  void Mark(CutProblem& problem);

 private:
  struct Plane {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    float offset_m = 0;  ///< normal * point + offset = 0
  };

  void CollectCandidates(const CutProblem& problem);
  Plane BestPlane(const CutProblem& problem);
  bool PlaneAround(const CutProblem& problem, int candidate, Plane& plane);
  int CountOn(const Plane& plane, int step) const;
  void Refit(Plane& plane) const;
  bool IsOn(const Plane& plane, const Eigen::Vector3f& point) const;
  void TakeFrom(const Plane& plane, CutProblem& problem);
  void Spread(const Plane& plane, CutProblem& problem);
  int Random(int end);

  const BackgroundSurfacesConfig config_;
  const DepthNoiseConfig noise_;
  std::uint64_t random_state_ = 0;
  std::vector<Eigen::Vector3f> points_;  ///< of cells far from every seed
  std::vector<cv::Point> places_;        ///< of the same, in the region
  std::vector<cv::Point> front_;         ///< cells to spread from
  Grid<std::uint8_t> reached_;
};

}  // namespace posefusion
