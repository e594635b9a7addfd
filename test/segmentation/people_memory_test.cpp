#include "posefusion/segmentation/people_memory.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

/// One cell of a tracked person that the cuts of a person seen now leave out, or cover.
class PeopleMemoryTest : public testing::Test {
 protected:
  PeopleMemoryTest() {
    CameraModel camera;
    camera.width = camera.height = 4;
    camera.fx = camera.fy = 100;
    cells_.Build(cv::Mat(4, 4, CV_32FC1, cv::Scalar(1)), camera);
    person_ = *tracks_.Add(0);
    seen_.cuts = {{person_, false, cv::Mat::zeros(1, 1, CV_8UC1)}};
    seen_.near_seeds = cv::Mat(1, 1, CV_8UC1, cv::Scalar(kNearSeeds));
    seen_.surfaces = cv::Mat::zeros(1, 1, CV_8UC1);
  }

  /// Evidence after one frame that began with `before`.
  float After(float before, CellPerson person) {
    CellPeople people;
    people.Forget(cells_.size());
    people.person.at(0, 0) = person;
    people.evidence.at(0, 0) = before;
    UpdatePeople(&seen_, {}, cells_, 0, tracks_, people);
    return people.evidence.at(0, 0);
  }

  CellGrid cells_{CellGridConfig()};
  PersonTracks tracks_{PersonHoldConfig()};
  CellPerson person_ = kNobody;
  KeypointCuts seen_;
};

TEST_F(PeopleMemoryTest, ForgetsLessFarFromAllSeeds) {
  const float near = After(0.8F, person_);
  seen_.near_seeds.setTo(kFarFromSeeds);
  const float far = After(0.8F, person_);
  EXPECT_LT(near, far);
  EXPECT_LT(far, 0.8F);
}

TEST_F(PeopleMemoryTest, ForgetsMoreOnALargePlane) {
  const float elsewhere = After(0.8F, person_);
  seen_.surfaces.setTo(1);
  EXPECT_LT(After(0.8F, person_), elsewhere);
}

TEST_F(PeopleMemoryTest, ForgetsNothingOfABodyWhoseTrunkWasNotFound) {
  seen_.cuts.front().trunk = 0;
  EXPECT_EQ(After(0.8F, person_), 0.8F);
  seen_.cuts.front().trunk = 0.4F;
  const float little = After(0.8F, person_);
  seen_.cuts.front().trunk = 1;
  EXPECT_LT(After(0.8F, person_), little);
  EXPECT_LT(little, 0.8F);
}

TEST_F(PeopleMemoryTest, BelievesMoreAtASeed) {
  seen_.cuts.front().cells.setTo(255);
  const float near = After(-1, kNobody);
  seen_.near_seeds.setTo(kAtSeeds);
  EXPECT_GT(After(-1, kNobody), near);
  EXPECT_GT(near, -1);
}

TEST_F(PeopleMemoryTest, KeypointsDecideAtOnceWhatOnlyNeighboursHaveDecided) {
  seen_.cuts.front().cells.setTo(255);
  EXPECT_EQ(After(-kWeakEvidence, kNobody), kFirstEvidence);
  EXPECT_LT(After(-2 * kWeakEvidence, kNobody), kFirstEvidence);
}

TEST_F(PeopleMemoryTest, ACarriedCutTakesBackWhatOnlyNeighboursHaveDecided) {
  const std::vector<PersonCut> carried = {
      {person_, false, cv::Mat(1, 1, CV_8UC1, cv::Scalar(255))}};
  for (const float before : {-kWeakEvidence, -2 * kWeakEvidence}) {
    CellPeople people;
    people.Forget(cells_.size());
    people.person.at(0, 0) = kNobody;
    people.evidence.at(0, 0) = before;
    const bool is_weak = IsWeakBackground(people, 0, 0);
    UpdatePeople(nullptr, carried, cells_, 0, tracks_, people);
    EXPECT_EQ(people.person.at(0, 0), is_weak ? person_ : kNobody);
    EXPECT_EQ(people.evidence.at(0, 0), is_weak ? kWeakEvidence : before);
  }
}

}  // namespace
}  // namespace posefusion
