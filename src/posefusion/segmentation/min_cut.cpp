#include "posefusion/segmentation/min_cut.h"

#include <algorithm>

#include "posefusion/segmentation/min_cut_grid.h"
#include "posefusion/segmentation/min_cut_pcl.h"

namespace posefusion {

std::unique_ptr<MinCut> MakeMinCut(const MinCutConfig& config) {
  if (config.backend == MinCutBackend::kPcl) return std::make_unique<MinCutPcl>(config);
  return std::make_unique<MinCutGrid>(config);
}

float LimitedPenalty(const MinCutConfig& config, float radius_m, float in_share_m, float beyond_m,
                     bool leaves_image) {
  const double limit = leaves_image ? config.unseen_penalty : config.max_penalty;
  return std::min(in_share_m / radius_m, static_cast<float>(limit)) +
         std::max(beyond_m, 0.0F) / radius_m;
}

Eigen::Matrix3f RotationToPenaltyFrame(const std::optional<Eigen::Vector3f>& gravity) {
  if (!gravity) return Eigen::Matrix3f::Identity();
  const Eigen::Quaternionf q =
      Eigen::Quaternionf::FromTwoVectors(*gravity, Eigen::Vector3f::UnitZ());
  return q.toRotationMatrix();
}

}  // namespace posefusion
