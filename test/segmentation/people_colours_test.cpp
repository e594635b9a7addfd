#include "posefusion/segmentation/people_colours.h"

#include <gtest/gtest.h>

#include "posefusion/segmentation/people_memory.h"

namespace posefusion {
namespace {

const cv::Vec3b kRed(200, 20, 20);
const cv::Vec3b kGrey(120, 120, 120);
const cv::Vec3b kGreen(20, 200, 20);

/// The left half is red and somebody's, the right half is grey and nobody's.
class PeopleColoursTest : public testing::Test {
 protected:
  PeopleColoursTest() : image_(4, 8, CV_8UC3, cv::Scalar(120, 120, 120)) {
    image_(cv::Rect(0, 0, 4, 4)).setTo(cv::Scalar(200, 20, 20));
    people_.Forget(image_.size());
    near_seeds_ = cv::Mat(image_.size(), CV_8UC1, cv::Scalar(kFarFromSeeds));
    near_seeds_(cv::Rect(0, 0, 4, 4)).setTo(kOnSeeds);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) {
        people_.person.at(x, y) = x < 4 ? 1 : kNobody;
        people_.evidence.at(x, y) = x < 4 ? 0.8F : -0.8F;
      }
    }
  }

  void Add() { colours_.Add(image_, people_, near_seeds_); }

  cv::Mat image_;
  CellPeople people_;
  cv::Mat near_seeds_;
  PeopleColoursConfig config_;
  PeopleColours colours_{config_};
};

TEST_F(PeopleColoursTest, SayNothingBeforeAnythingWasSeen) {
  EXPECT_EQ(colours_.LogRatio(kRed), 0);
}

TEST_F(PeopleColoursTest, TellPeopleFromBackgroundWithinTheLimit) {
  for (int i = 0; i < 20; ++i) Add();
  const auto limit = static_cast<float>(config_.max_log_ratio);
  EXPECT_EQ(colours_.LogRatio(kRed), limit);
  EXPECT_EQ(colours_.LogRatio(kGrey), -limit);
  EXPECT_NEAR(colours_.LogRatio(kGreen), 0, 0.5F);
}

TEST_F(PeopleColoursTest, LearnPeopleOnlyWhereTheyAreCertain) {
  near_seeds_.setTo(kAtSeeds);
  Add();
  EXPECT_LT(colours_.LogRatio(kRed), 0.5F) << "beside seeds there may be background";
  near_seeds_.setTo(kOnSeeds);
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) people_.evidence.at(x, y) = 0.1F;
  }
  Add();
  EXPECT_LT(colours_.LogRatio(kRed), 0.5F) << "little speaks for a person";
}

TEST_F(PeopleColoursTest, ForgetWhatIsNotSeenAnyMore) {
  for (int i = 0; i < 20; ++i) Add();
  image_(cv::Rect(0, 0, 4, 4)).setTo(cv::Scalar(20, 200, 20));
  image_(cv::Rect(4, 0, 4, 4)).setTo(cv::Scalar(200, 20, 20));
  for (int i = 0; i < 200; ++i) Add();
  EXPECT_LT(colours_.LogRatio(kRed), -1);
  EXPECT_GT(colours_.LogRatio(kGreen), 1);
}

}  // namespace
}  // namespace posefusion
