#pragma once

#include "posefusion/segmentation/min_cut.h"

namespace posefusion {

/// Min-cut on the image's own neighbourhood: each cell has edges to the eight around it. The
/// maximum flow is OpenCV's GCGraph (Boykov and Kolmogorov 2004).
///
/// Own extensions to the paper's weights: equation 3 in space (penalty_distance: space); it stops
/// growing at max_penalty, hardly above source_weight, so that parts of a body without a seed go
/// with what they are connected to, until it goes on at reach_m; and C multiplied by exp(-(dz /
/// depth_gap_sigma_m)^2), dz the difference in depth: neighbours in the image need not be
/// neighbours in space; and by a share that falls with the difference in colour.
class MinCutGrid : public MinCut {
 public:
  explicit MinCutGrid(const MinCutConfig& config);

  void Solve(const CutProblem& problem, cv::Mat& person) override;

 private:
  void AddVertices(const CutProblem& problem);
  float PenaltyAt(const CutProblem& problem, const SeedDistance& distance,
                  const Eigen::Vector3f& p_camera, const Eigen::Vector3f& p) const;
  float SurfaceShare(CellState a, CellState b) const;
  int SmoothnessWeight(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float share) const;
  struct CellCosts {
    float as_background;
    float as_person;
  };
  CellCosts CostsOf(const CutProblem& problem, const SeedDistance& distance, std::size_t i,
                    const Eigen::Vector3f& p) const;
  static float ColourGain(const CutProblem& problem, const cv::Point& cell);
  float ColourShare(const CutProblem& problem, const cv::Point& a, const cv::Point& b) const;

  const MinCutConfig config_;
  Grid<int> vertices_;                   ///< number of each cell's vertex; -1 = none
  std::vector<Eigen::Vector3f> points_;  ///< of the vertices
  std::vector<cv::Point> places_;        ///< of the vertices, in the region
  std::vector<BodyPoint> seeds_;         ///< in the penalty's frame
};

}  // namespace posefusion
