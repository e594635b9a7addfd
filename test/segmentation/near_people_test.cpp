#include "posefusion/segmentation/near_people.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr int kCell = 4;

/// A room 3 m away with a hole in its depth whose left rim is near.
class NearPeopleTest : public testing::Test {
 protected:
  NearPeopleTest() {
    camera_.width = 320;
    camera_.height = 240;
    camera_.fx = camera_.fy = 260;
    camera_.cx = 160;
    camera_.cy = 120;
    Look({100, 40, 120, 200});
  }

  void Look(const cv::Rect& hole) {
    cv::Mat depth_m(240, 320, CV_32FC1, cv::Scalar(3));
    depth_m(hole).setTo(0);
    const cv::Rect rim(hole.x - 8, hole.y, 8, hole.height);
    depth_m(rim & cv::Rect(0, 0, 320, 240)).setTo(0.6);
    cells_.Build(depth_m, camera_);
  }

  static Skeletons JointAt(float u, float v, float p) {
    Skeletons skeletons;
    skeletons.people.emplace_back();
    skeletons.people.front()[kRightShoulder] = {u, v, p};
    return skeletons;
  }

  bool IsPerson(const NearPeople& people, int u, int v) const {
    return !people.cells.empty() && people.cells.at<std::uint8_t>(v / kCell, u / kCell) != 0;
  }

  CameraModel camera_;
  CellGrid cells_{CellGridConfig{kCell}};
  NearPeopleConfig config_;
};

TEST_F(NearPeopleTest, FillTheHoleThatAJointLiesInWithItsNearRim) {
  const Skeletons skeletons = JointAt(160, 120, 0.9F);
  const NearPeople people = FindNearPeople(cells_, &skeletons, {}, 0, config_);
  EXPECT_TRUE(IsPerson(people, 110, 60));
  EXPECT_TRUE(IsPerson(people, 210, 230));
  EXPECT_TRUE(IsPerson(people, 95, 100)) << "near rim";
  EXPECT_FALSE(IsPerson(people, 230, 100)) << "the room beside";
  EXPECT_FALSE(IsPerson(people, 60, 100)) << "the room beyond the rim";
}

TEST_F(NearPeopleTest, NeedACertainJointInsideALargeHole) {
  for (const Skeletons& skeletons :
       {JointAt(160, 120, 0.3F), JointAt(20, 20, 0.9F), JointAt(-50, 9999, 0.9F)}) {
    EXPECT_TRUE(FindNearPeople(cells_, &skeletons, {}, 0, config_).cells.empty());
  }
  Look({150, 110, 20, 20});
  const Skeletons skeletons = JointAt(160, 120, 0.9F);
  EXPECT_TRUE(FindNearPeople(cells_, &skeletons, {}, 0, config_).cells.empty()) << "small hole";
}

TEST_F(NearPeopleTest, StayForAWhileWithoutJoints) {
  const Skeletons skeletons = JointAt(160, 120, 0.9F);
  const NearPeople first = FindNearPeople(cells_, &skeletons, {}, 10, config_);
  Look({104, 40, 120, 200});
  const NearPeople next = FindNearPeople(cells_, nullptr, first, 10.1, config_);
  EXPECT_TRUE(IsPerson(next, 160, 120));
  EXPECT_EQ(next.seen_s, 10);
  EXPECT_TRUE(FindNearPeople(cells_, nullptr, next, 11.1, config_).cells.empty()) << "too old";
}

TEST_F(NearPeopleTest, LeaveNothingBehindInAnotherHole) {
  const Skeletons skeletons = JointAt(160, 120, 0.9F);
  const NearPeople first = FindNearPeople(cells_, &skeletons, {}, 10, config_);
  Look({100, 40, 16, 200});  // a shadow at the border of where they were
  EXPECT_TRUE(FindNearPeople(cells_, nullptr, first, 10.1, config_).cells.empty());
}

}  // namespace
}  // namespace posefusion
