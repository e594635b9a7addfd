#include "posefusion/segmentation/min_cut.h"

#include "posefusion/segmentation/min_cut_grid.h"
#include "posefusion/segmentation/min_cut_pcl.h"

namespace posefusion {

std::unique_ptr<MinCut> MakeMinCut(const MinCutConfig& config) {
  if (config.backend == MinCutBackend::kPcl) return std::make_unique<MinCutPcl>(config);
  return std::make_unique<MinCutGrid>(config);
}

Eigen::Matrix3f RotationToPenaltyFrame(const std::optional<Eigen::Vector3f>& gravity) {
  if (!gravity) return Eigen::Matrix3f::Identity();
  const Eigen::Quaternionf q =
      Eigen::Quaternionf::FromTwoVectors(*gravity, Eigen::Vector3f::UnitZ());
  return q.toRotationMatrix();
}

}  // namespace posefusion
