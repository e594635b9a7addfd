#include "posefusion/segmentation/min_cut_pcl.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/min_cut_segmentation.h>

namespace posefusion {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr std::size_t kMaxCertainSeeds = 300;  ///< foreground points of cells; PCL tries all

pcl::PointXYZ ToPcl(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

/// The cells of a problem as a cloud; PCL crashes when it is to use only a part of a cloud.
struct CellCloud {
  Cloud::Ptr points{new Cloud};
  Cloud::Ptr foreground{new Cloud};
  std::vector<cv::Point> places;   ///< of the points, in the region
  std::vector<cv::Point> certain;  ///< of the points that are certainly person
};

CellCloud MakeCloud(const CutProblem& problem) {
  const Eigen::Matrix3f R = RotationToPenaltyFrame(problem.gravity);
  CellCloud cloud;
  for (const BodyPoint& seed : problem.seeds) {
    cloud.foreground->push_back(ToPcl(R * seed.p_camera));
  }
  for (int y = 0; y < problem.region.height; ++y) {
    for (int x = 0; x < problem.region.width; ++x) {
      const CellState state = problem.states.at(x, y);
      if (state != CellState::kFree && state != CellState::kPerson) continue;
      const Eigen::Vector3f point =
          problem.cells->PointAt(problem.region.x + x, problem.region.y + y);
      cloud.points->push_back(ToPcl(R * point));
      cloud.places.emplace_back(x, y);
      if (state == CellState::kPerson) cloud.certain.emplace_back(x, y);
    }
  }
  const std::size_t step = 1 + cloud.certain.size() / kMaxCertainSeeds;
  for (std::size_t i = 0; i < cloud.certain.size(); i += step) {
    const cv::Point place = cloud.certain[i] + problem.region.tl();
    cloud.foreground->push_back(ToPcl(R * problem.cells->PointAt(place.x, place.y)));
  }
  return cloud;
}

}  // namespace

MinCutPcl::MinCutPcl(const MinCutConfig& config) : config_(config) {}

void MinCutPcl::Solve(const CutProblem& problem, cv::Mat& person) {
  person.create(problem.region.size(), CV_8UC1);
  person.setTo(0);
  const CellCloud cloud = MakeCloud(problem);
  if (cloud.points->empty() || cloud.foreground->empty()) return;
  pcl::MinCutSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud.points);
  segmentation.setForegroundPoints(cloud.foreground);
  segmentation.setRadius(problem.radius_m);
  segmentation.setSigma(config_.sigma_m);
  segmentation.setSourceWeight(problem.source_weight);
  segmentation.setNumberOfNeighbours(static_cast<unsigned>(config_.pcl_neighbours));
  std::vector<pcl::PointIndices> clusters;
  segmentation.extract(clusters);
  constexpr std::size_t kForeground = 1;  // of PCL's two clusters
  if (clusters.size() <= kForeground) return;
  for (const int index : clusters[kForeground].indices) {
    person.at<std::uint8_t>(cloud.places[static_cast<std::size_t>(index)]) = 255;
  }
  for (const cv::Point& place : cloud.certain) person.at<std::uint8_t>(place) = 255;
}

}  // namespace posefusion
