#include "posefusion/segmentation/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

namespace posefusion {
namespace {

/// Depth of the one cell of an image of 3x3 pixels.
float DepthOf(const cv::Mat& depth_m) {
  CellGrid cells(CellGridConfig{3});
  cells.Build(depth_m, CameraModel{3, 3, 100, 100, 1, 1, {}});
  return cells.DepthAt(0, 0);
}

TEST(CellGrid, TakesTheLowerMedianOfWhatHasDepth) {
  cv::RNG random(3);
  for (int i = 0; i < 500; ++i) {
    cv::Mat depth_m(3, 3, CV_32FC1);
    random.fill(depth_m, cv::RNG::UNIFORM, 0.5, 5.0);
    for (int missing = random.uniform(0, 10); missing > 4; --missing) {
      depth_m.at<float>(random.uniform(0, 3), random.uniform(0, 3)) = 0;
    }
    std::vector<float> known;
    for (const float z : cv::Mat_<float>(depth_m)) {
      if (z > 0) known.push_back(z);
    }
    std::sort(known.begin(), known.end());
    ASSERT_EQ(DepthOf(depth_m), known[(known.size() - 1) / 2]);
  }
}

TEST(CellGrid, HasNoDepthWhereNothingHas) { EXPECT_EQ(DepthOf(cv::Mat::zeros(3, 3, CV_32FC1)), 0); }

}  // namespace
}  // namespace posefusion
