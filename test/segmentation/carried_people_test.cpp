#include "posefusion/segmentation/carried_people.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr CellPerson kSomebody = 3;
constexpr int kFirstColumn = 10;  ///< of somebody
constexpr int kLastColumn = 15;

/// Somebody before a wall of the same depth, who moves to the right.
class CarriedPeopleTest : public testing::Test {
 protected:
  CarriedPeopleTest() {
    const CameraModel camera{160, 120, 130, 130, 79.5, 59.5, {}};
    cells_.Build(cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(2)), camera);
    people_.Forget(cells_.size());
    for (int y = 0; y < cells_.height(); ++y) {
      for (int x = 0; x < cells_.width(); ++x) {
        const bool is_person = x >= kFirstColumn && x <= kLastColumn;
        people_.person.at(x, y) = is_person ? kSomebody : kNobody;
      }
    }
  }

  /// Everything moves by so many cells in every frame.
  void Move(float cells_per_frame, int num_frames) {
    const cv::Mat motion(cells_.size(), CV_32FC2, cv::Scalar(-cells_per_frame, 0));
    for (int i = 0; i < num_frames; ++i) {
      CellPeople now;
      CarryPeople(people_, cells_, motion, cells_, 1.0 / 30, CarryConfig(), now);
      people_ = now;
    }
  }

  void ExpectSomebodyAt(int first, int last) const {
    const int row = cells_.height() / 2;
    for (int x = last - 10; x <= last + 10; ++x) {
      const bool is_person = people_.person.at(x, row) == kSomebody;
      EXPECT_EQ(is_person, x >= first && x <= last) << "column " << x;
    }
  }

  CellGrid cells_{CellGridConfig()};
  CellPeople people_;
};

TEST_F(CarriedPeopleTest, GoAlongWithTheImage) {
  Move(2, 3);
  ExpectSomebodyAt(kFirstColumn + 6, kLastColumn + 6);
}

TEST_F(CarriedPeopleTest, GoAlongByLessThanACellAFrame) {
  Move(0.29F, 10);
  ExpectSomebodyAt(kFirstColumn + 3, kLastColumn + 3);
  Move(-0.29F, 10);
  ExpectSomebodyAt(kFirstColumn, kLastColumn);
}

TEST_F(CarriedPeopleTest, AreUnknownWhereTheDepthIsAnother) {
  const CellGrid before = cells_;
  const CameraModel camera{160, 120, 130, 130, 79.5, 59.5, {}};
  cells_.Build(cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(2.5)), camera);
  CellPeople now;
  CarryPeople(people_, before, cv::Mat::zeros(cells_.size(), CV_32FC2), cells_, 1.0 / 30,
              CarryConfig(), now);
  EXPECT_EQ(now.person.at(kFirstColumn, 10), kUnknownCell);
  EXPECT_EQ(now.person.at(0, 10), kUnknownCell);
}

}  // namespace
}  // namespace posefusion
