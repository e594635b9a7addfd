#include "posefusion/image/shift_proposals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/image/synthetic_images.h"

namespace posefusion {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

cv::Mat SmallRoom() {
  cv::Mat grey;
  cv::cvtColor(RoomImage(1), grey, cv::COLOR_RGB2GRAY);
  cv::resize(grey, grey, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  grey.convertTo(grey, CV_32F);
  return grey;
}

cv::Mat Moved(const cv::Mat& image, cv::Point2d shift) {
  cv::Mat moved;
  cv::warpAffine(image, moved, cv::Matx23d(1, 0, shift.x, 0, 1, shift.y), image.size(),
                 cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return moved;
}

bool HasNear(const std::vector<cv::Point2f>& shifts, cv::Point2f wanted) {
  return std::any_of(shifts.begin(), shifts.end(),
                     [&](const cv::Point2f& shift) { return cv::norm(shift - wanted) < 0.7; });
}

TEST(ShiftProposals, NamesTheShiftOfEachPart) {
  const cv::Mat room = SmallRoom();
  cv::Mat now = Moved(room, {6, 2});
  const cv::Rect right(kWidth / 2, 0, kWidth / 2, kHeight);
  Moved(room, {-15, 4})(right).copyTo(now(right));
  ShiftProposals proposals;
  EXPECT_TRUE(proposals.Next(room).empty());
  const std::vector<cv::Point2f> shifts = proposals.Next(now);
  EXPECT_TRUE(HasNear(shifts, {6, 2}));
  EXPECT_TRUE(HasNear(shifts, {-15, 4}));
}

TEST(ShiftProposals, KnowsNothingOfWallsAndAfterForgetting) {
  const cv::Mat flat(kHeight, kWidth, CV_32FC1, cv::Scalar(200));
  ShiftProposals proposals;
  proposals.Next(SmallRoom());
  EXPECT_TRUE(proposals.Next(flat).empty());
  proposals.Next(SmallRoom());
  proposals.Forget();
  EXPECT_TRUE(proposals.Next(SmallRoom()).empty());
}

}  // namespace
}  // namespace posefusion
