#include "posefusion/segmentation/mask_refinement.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

/// The cut of cells that are nearer than anything but the person is.
cv::Mat CellMask(const CellGrid& cells) {
  cv::Mat mask(cells.size(), CV_8UC1);
  for (int y = 0; y < cells.height(); ++y) {
    for (int x = 0; x < cells.width(); ++x) {
      mask.at<std::uint8_t>(y, x) = cells.DepthAt(x, y) > 0 && cells.DepthAt(x, y) < 2.3F ? 255 : 0;
    }
  }
  return mask;
}

class MaskRefinementTest : public testing::Test {
 protected:
  MaskRefinementTest() : frame_(scene_.Render()) {}

  cv::Mat Refine(const MaskRefinementConfig& config) {
    CellGrid cells{CellGridConfig()};
    cells.Build(frame_.depth_m, frame_.camera);
    cv::Mat mask = cv::Mat::zeros(frame_.depth_m.size(), CV_8UC1);
    MaskRefinement(config).Apply(CellMask(cells), cells, frame_.depth_m, mask);
    return mask;
  }

  static MaskRefinementConfig Exact() {
    MaskRefinementConfig config;
    config.grow_px = 0;
    config.fill_px = 0;
    return config;
  }

  SyntheticScene scene_;
  RgbdFrame frame_;
};

TEST_F(MaskRefinementTest, FollowsDepthEdgesToThePixel) {
  const cv::Rect above_the_feet(0, 0, 640, 470);
  cv::Mat difference;
  cv::bitwise_xor(Refine(Exact())(above_the_feet), scene_.TrueMask()(above_the_feet), difference);
  EXPECT_EQ(cv::countNonZero(difference), 0);
}

TEST_F(MaskRefinementTest, GrowsByTheRim) {
  MaskRefinementConfig config = Exact();
  const cv::Mat exact = Refine(config);
  config.grow_px = 2;
  const cv::Mat grown = Refine(config);
  EXPECT_EQ(cv::countNonZero(grown.row(240)), cv::countNonZero(exact.row(240)) + 4);
}

TEST_F(MaskRefinementTest, TakesPixelsWithoutDepthBesideThePerson) {
  frame_.depth_m(cv::Rect(200, 200, 61, 40)).setTo(0);  // ends at the person's right edge
  MaskRefinementConfig config = Exact();
  config.fill_px = 8;
  const cv::Mat mask = Refine(config);
  const auto* row = mask.ptr<std::uint8_t>(220);
  EXPECT_EQ(row[258], 255);
  EXPECT_EQ(row[240], 0);
  EXPECT_EQ(mask.at<std::uint8_t>(100, 258), 0) << "has depth";
}

TEST_F(MaskRefinementTest, LeavesTheRestOfTheMaskAlone) {
  CellGrid cells{CellGridConfig()};
  cells.Build(frame_.depth_m, frame_.camera);
  cv::Mat mask = cv::Mat::zeros(frame_.depth_m.size(), CV_8UC1);
  mask.at<std::uint8_t>(5, 5) = 255;
  MaskRefinement refinement{MaskRefinementConfig()};
  refinement.Apply(CellMask(cells), cells, frame_.depth_m, mask);
  EXPECT_EQ(mask.at<std::uint8_t>(5, 5), 255);
  EXPECT_EQ(mask.at<std::uint8_t>(5, 300), 0);
}

}  // namespace
}  // namespace posefusion
