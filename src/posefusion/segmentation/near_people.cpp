#include "posefusion/segmentation/near_people.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace posefusion {
namespace {

/// A hole is still somebody's when this much of it was before ...
constexpr double kSharedOfHole = 0.5;
/// ... and it has this much of what they filled before.
constexpr double kSharedOfPeople = 0.3;

cv::Mat CellsWithoutDepth(const CellGrid& cells) {
  cv::Mat holes(cells.size(), CV_8UC1);
  for (int y = 0; y < holes.rows; ++y) {
    for (int x = 0; x < holes.cols; ++x) {
      holes.at<std::uint8_t>(y, x) = cells.DepthAt(x, y) > 0 ? 0 : 255;
    }
  }
  return holes;
}

/// Number of certain joints in each hole.
std::vector<int> JointsIn(const cv::Mat& labels, int num_labels, const Skeletons& skeletons,
                          const CellGrid& cells, double min_confidence) {
  std::vector<int> joints(static_cast<std::size_t>(num_labels), 0);
  for (const Skeleton& skeleton : skeletons.people) {
    for (const Joint& joint : skeleton) {
      if (!(joint.p >= static_cast<float>(min_confidence))) continue;
      const auto cell = cells.CellAt({joint.u, joint.v});
      if (cell) ++joints[static_cast<std::size_t>(labels.at<int>(*cell))];
    }
  }
  return joints;
}

/// Near cells around the holes.
void AddRim(const CellGrid& cells, const NearPeopleConfig& config, cv::Mat& people) {
  const int size = 2 * config.margin_cells + 1;
  cv::Mat around;
  cv::dilate(people, around, cv::getStructuringElement(cv::MORPH_RECT, {size, size}), {-1, -1}, 1,
             cv::BORDER_CONSTANT);
  for (int y = 0; y < people.rows; ++y) {
    for (int x = 0; x < people.cols; ++x) {
      const float z = cells.DepthAt(x, y);
      if (around.at<std::uint8_t>(y, x) == 0 || z <= 0) continue;
      if (z < static_cast<float>(config.max_depth_m)) people.at<std::uint8_t>(y, x) = 255;
    }
  }
}

}  // namespace

NearPeople FindNearPeople(const CellGrid& cells, const Skeletons* skeletons,
                          const NearPeople& before, double time_s, const NearPeopleConfig& config) {
  NearPeople now;
  if (!config.enabled) return now;
  const bool is_held = before.seen_s && time_s - *before.seen_s <= config.hold_s &&
                       before.cells.size() == cells.size();
  if (skeletons == nullptr && !is_held) return now;
  cv::Mat labels;
  cv::Mat statistics;
  cv::Mat centres;
  const int num_labels = cv::connectedComponentsWithStats(CellsWithoutDepth(cells), labels,
                                                          statistics, centres, 4, CV_32S);
  std::vector<int> joints(static_cast<std::size_t>(num_labels), 0);
  if (skeletons != nullptr) {
    joints = JointsIn(labels, num_labels, *skeletons, cells, config.min_joint_confidence);
  }
  const int num_before = is_held ? cv::countNonZero(before.cells) : 0;
  for (int label = 1; label < num_labels; ++label) {
    const int size = statistics.at<int>(label, cv::CC_STAT_AREA);
    if (size < config.min_cells) continue;
    const cv::Mat hole = labels == label;
    const bool has_joints = joints[static_cast<std::size_t>(label)] > 0;
    const int shared = is_held ? cv::countNonZero(hole & before.cells) : 0;
    const bool is_same =
        is_held && shared >= kSharedOfHole * size && shared >= kSharedOfPeople * num_before;
    if (!has_joints && !is_same) continue;
    if (now.cells.empty()) now.cells = cv::Mat::zeros(cells.size(), CV_8UC1);
    now.cells.setTo(255, hole);
    if (has_joints) now.seen_s = time_s;
  }
  if (now.cells.empty()) return now;
  if (!now.seen_s) now.seen_s = before.seen_s;
  AddRim(cells, config, now.cells);
  return now;
}

}  // namespace posefusion
