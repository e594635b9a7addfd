#include "posefusion/segmentation/remembered_people.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr CellPerson kSomebody = 7;

/// Somebody two metres away at the left border of the view, before a wall, and a camera that turns
/// away and back.
class RememberedPeopleTest : public testing::Test {
 protected:
  RememberedPeopleTest() {
    Show(cells_before_, 2);
    before_.Forget(cells_before_.size());
    for (int y = 0; y < cells_before_.height(); ++y) {
      for (int x = 0; x < 10; ++x) {
        before_.person.at(x, y) = kSomebody;
        before_.evidence.at(x, y) = 0.9F;
      }
    }
  }

  /// The left quarter at a depth of its own.
  void Show(CellGrid& cells, float left_m) {
    CameraModel camera{160, 120, 130, 130, 79.5, 59.5, {}};
    cv::Mat depth(camera.height, camera.width, CV_32FC1, cv::Scalar(4));
    depth.colRange(0, 40).setTo(left_m);
    cells.Build(depth, camera);
  }

  /// Takes the people on by one frame; `people` then holds who was found again.
  void Step(const CellPeople& from, const RememberedPeople& remembered,
            const Eigen::Isometry3f& T_before_now, const CellGrid& cells, double time_s) {
    people_.Forget(cells.size());
    RememberedPeople result;
    RememberPeople({from, cells_before_, remembered, 0, velocities_}, T_before_now, cells, time_s,
                   config_, people_, result);
    remembered_ = result;
  }

  int NumFound() const {
    int count = 0;
    for (int y = 0; y < people_.person.height(); ++y) {
      for (int x = 0; x < people_.person.width(); ++x)
        count += people_.person.at(x, y) == kSomebody;
    }
    return count;
  }

  static Eigen::Isometry3f TurnedRight(float rad) {
    Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
    T.rotate(Eigen::AngleAxisf(rad, Eigen::Vector3f::UnitY()));
    return T;
  }

  CellPeople Nobody() const {
    CellPeople nobody;
    nobody.Forget(cells_before_.size());
    return nobody;
  }

  RememberedPeopleConfig config_;
  CellGrid cells_before_{CellGridConfig()};
  CellGrid cells_now_{CellGridConfig()};
  CellPeople before_;
  CellPeople people_;
  RememberedPeople remembered_;
  PeopleVelocities velocities_;
};

TEST_F(RememberedPeopleTest, WhoeverWalksIsLookedForFartherOn) {
  velocities_[kSomebody] = Eigen::Vector3f(0, 0, -2);
  Show(cells_now_, 2);
  Step(before_, {}, Eigen::Isometry3f::Identity(), cells_now_, 0.2);
  EXPECT_EQ(NumFound(), 0) << "something else is where somebody was";
  Show(cells_now_, 1.6F);
  Step(before_, {}, Eigen::Isometry3f::Identity(), cells_now_, 0.2);
  EXPECT_GT(NumFound(), 120) << "of what has not left the view";
}

TEST_F(RememberedPeopleTest, WhoeverOnlySwaysStays) {
  velocities_[kSomebody] = Eigen::Vector3f(0, 0, -0.2F);
  Show(cells_now_, 2);
  Step(before_, {}, Eigen::Isometry3f::Identity(), cells_now_, 1);
  EXPECT_GT(NumFound(), 250);
}

TEST_F(RememberedPeopleTest, SomebodyOutOfTheViewIsThereWhenTheCameraComesBack) {
  Show(cells_now_, 4);
  Step(before_, {}, TurnedRight(1), cells_now_, 0.1);
  EXPECT_EQ(NumFound(), 0);
  EXPECT_EQ(remembered_.size(), 300U);
  Show(cells_now_, 2);
  Step(Nobody(), remembered_, TurnedRight(-1), cells_now_, 0.2);
  EXPECT_GT(NumFound(), 250);
  EXPECT_TRUE(remembered_.empty());
}

TEST_F(RememberedPeopleTest, SomebodyHiddenStaysAndSomebodySeenThroughDoesNot) {
  Show(cells_now_, 1);
  Step(before_, {}, Eigen::Isometry3f::Identity(), cells_now_, 0.1);
  EXPECT_EQ(NumFound(), 0);
  EXPECT_EQ(remembered_.size(), 300U);
  Show(cells_now_, 4);
  Step(before_, {}, Eigen::Isometry3f::Identity(), cells_now_, 0.1);
  EXPECT_EQ(NumFound(), 0);
  EXPECT_TRUE(remembered_.empty());
}

TEST_F(RememberedPeopleTest, NobodyIsRememberedForLong) {
  Show(cells_now_, 4);
  Step(before_, {}, TurnedRight(1), cells_now_, 0.1);
  Step(Nobody(), remembered_, Eigen::Isometry3f::Identity(), cells_now_, config_.memory_s + 0.1);
  EXPECT_TRUE(remembered_.empty());
}

TEST_F(RememberedPeopleTest, WhatIsKnownOfACellStays) {
  Show(cells_now_, 2);
  people_.Forget(cells_now_.size());
  people_.person.Fill(kNobody);
  RememberedPeople remembered;
  RememberPeople({before_, cells_before_, {}, 0, velocities_}, Eigen::Isometry3f::Identity(),
                 cells_now_, 0.1, config_, people_, remembered);
  EXPECT_EQ(NumFound(), 0);
}

}  // namespace
}  // namespace posefusion
