#pragma once

#include "posefusion/segmentation/min_cut.h"

namespace posefusion {

/// Min-cut by pcl::MinCutSegmentation (Golovinskiy and Funkhouser 2009): a graph of the nearest
/// neighbours in space, with the paper's weights and nothing else. PCL knows no certain points:
/// cells that are certainly background are left out of the cloud, cells that are certainly person
/// become foreground points and stay person after the cut.
class MinCutPcl : public MinCut {
 public:
  explicit MinCutPcl(const MinCutConfig& config);

  void Solve(const CutProblem& problem, cv::Mat& person) override;

 private:
  const MinCutConfig config_;
};

}  // namespace posefusion
