#include "posefusion/segmentation/human_remover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "test/segmentation/moving_person.h"

namespace posefusion {
namespace {

using Arrivals = std::function<std::vector<Skeletons>(int)>;

/// Masks of the first frames, with the keypoints that `arrivals` gives for each.
std::vector<HumanCut> CutFrames(HumanRemover& remover, int num_frames, const Arrivals& arrivals) {
  std::vector<HumanCut> cuts;
  for (int i = 0; i < num_frames; ++i) {
    cuts.push_back(remover.Process(MovingPerson().FrameAt(i), arrivals(i)));
  }
  return cuts;
}

const Arrivals kOnTime = [](int i) {
  return std::vector<Skeletons>{MovingPerson().SkeletonsAt(i)};
};

void ExpectFound(const HumanCut& cut, int index) {
  const SyntheticScene scene = MovingPerson().SceneAt(index);
  EXPECT_GT(Recall(cut.mask, scene), 0.9) << index;
  EXPECT_GT(Precision(cut.mask, scene), 0.9) << index;
  EXPECT_EQ(cut.num_people, 1) << index;
}

TEST(HumanRemover, CutsOutWhoeverKeypointsShow) {
  HumanRemover remover{HumanRemovalConfig()};
  const auto cuts = CutFrames(remover, 5, kOnTime);
  for (int i = 0; i < 5; ++i) {
    ExpectFound(cuts[static_cast<std::size_t>(i)], i);
    EXPECT_TRUE(cuts[static_cast<std::size_t>(i)].has_own_keypoints);
    EXPECT_EQ(cuts[static_cast<std::size_t>(i)].mask_age_s, 0.0);
  }
}

TEST(HumanRemover, WithoutKeypointsNobodyIsThere) {
  HumanRemover remover{HumanRemovalConfig()};
  const auto cuts = CutFrames(remover, 3, [](int) { return std::vector<Skeletons>(); });
  EXPECT_EQ(cv::countNonZero(cuts.back().mask), 0);
  EXPECT_EQ(cuts.back().num_people, 0);
  EXPECT_FALSE(cuts.back().mask_age_s);
}

TEST(HumanRemover, CarriesPeopleOnWhileNoKeypointsCome) {
  HumanRemover remover{HumanRemovalConfig()};
  constexpr int kLast = 20;
  const auto cuts = CutFrames(remover, kLast + 1,
                              [](int i) { return i <= 5 ? kOnTime(i) : std::vector<Skeletons>(); });
  ExpectFound(cuts.back(), kLast);
  EXPECT_FALSE(cuts.back().has_own_keypoints);
  EXPECT_NEAR(*cuts.back().mask_age_s, 0.033 * (kLast - 5), 1e-6);
}

TEST(HumanRemover, AdoptsValuesWithoutForgettingAnybody) {
  HumanRemover remover{HumanRemovalConfig()};
  CutFrames(remover, 6, kOnTime);
  HumanRemovalConfig changed;
  changed.min_cut.sigma_m = 0.3;
  changed.history_s = 9;
  remover.Adopt(changed);
  EXPECT_EQ(remover.config().min_cut.sigma_m, 0.3);
  EXPECT_EQ(remover.config().history_s, HumanRemovalConfig().history_s) << "is not for changing";
  ExpectFound(remover.Process(MovingPerson().FrameAt(6), {}), 6);
  changed.min_cut.sigma_m = -1;
  EXPECT_THROW(remover.Adopt(changed), std::invalid_argument);
  EXPECT_EQ(remover.config().min_cut.sigma_m, 0.3);
  changed.min_cut.sigma_m = 0.3;
  changed.policy = KeypointPolicy::kPass;
  remover.Adopt(changed);
  EXPECT_EQ(cv::countNonZero(remover.Process(MovingPerson().FrameAt(7), {}).mask), 0);
}

TEST(HumanRemover, LateKeypointsAreCarriedToThePresent) {
  constexpr int kDelay = 9;
  HumanRemover remover{HumanRemovalConfig()};
  const auto cuts = CutFrames(remover, 25, [](int i) {
    return i >= kDelay && i % 6 == 3 ? kOnTime(i - kDelay) : std::vector<Skeletons>();
  });
  EXPECT_EQ(cv::countNonZero(cuts[kDelay - 1].mask), 0);
  for (int i = kDelay; i < 25; ++i) ExpectFound(cuts[static_cast<std::size_t>(i)], i);
}

TEST(HumanRemover, LateKeypointsOfFollowedFramesAreUsed) {
  HumanRemover remover{HumanRemovalConfig()};
  for (int i = 0; i < 6; ++i) remover.Follow(MovingPerson().FrameAt(i));
  ExpectFound(remover.Process(MovingPerson().FrameAt(6), kOnTime(2)), 6);
  EXPECT_EQ(remover.counts().used, 1);
}

/// What is found of somebody five frames on, who was cut before and after, or followed as well.
double RecallAfterFiveFrames(bool follow) {
  MovingPerson person;
  person.speed_m = 0.08;
  HumanRemover remover{HumanRemovalConfig()};
  remover.Process(person.FrameAt(0), {person.SkeletonsAt(0)});
  for (int i = 1; i < 5 && follow; ++i) remover.Follow(person.FrameAt(i));
  return Recall(remover.Process(person.FrameAt(5), {}).mask, person.SceneAt(5));
}

TEST(HumanRemover, PeopleAreFollowedThroughFramesThatNobodyCuts) {
  EXPECT_LT(RecallAfterFiveFrames(false), 0.8) << "too fast";
  EXPECT_GT(RecallAfterFiveFrames(true), 0.95);
}

TEST(HumanRemover, FollowsNoFrameFromThePast) {
  HumanRemover remover{HumanRemovalConfig()};
  remover.Follow(MovingPerson().FrameAt(3));
  EXPECT_THROW(remover.Follow(MovingPerson().FrameAt(3)), std::invalid_argument);
  EXPECT_THROW(remover.Process(MovingPerson().FrameAt(2), {}), std::invalid_argument);
  ExpectFound(remover.Process(MovingPerson().FrameAt(4), kOnTime(4)), 4);
}

TEST(HumanRemover, WhoeverWasSeenForLongIsHeldWhenTheNetworkMissesThem) {
  HumanRemover remover{HumanRemovalConfig()};
  const auto cuts = CutFrames(remover, 30, [](int i) {
    return i < 20 ? kOnTime(i) : std::vector<Skeletons>{MovingPerson().NobodyAt(i)};
  });
  ExpectFound(cuts.back(), 29);
}

TEST(HumanRemover, WhoeverWasSeenForAMomentIsSoonForgotten) {
  HumanRemover remover{HumanRemovalConfig()};
  const auto cuts = CutFrames(remover, 12, [](int i) {
    Skeletons seen = i < 4 ? MovingPerson().SkeletonsAt(i) : MovingPerson().NobodyAt(i);
    for (Skeleton& person : seen.people) {
      for (Joint& joint : person) joint.p = std::min(joint.p, 0.4F);  // as of a false person
    }
    return std::vector<Skeletons>{seen};
  });
  EXPECT_GT(cv::countNonZero(cuts[3].mask), 0);
  EXPECT_EQ(cv::countNonZero(cuts.back().mask), 0);
  EXPECT_EQ(cuts.back().num_people, 0);
}

TEST(HumanRemover, WhoeverWasSeenWellForAMomentIsKeptALittleLonger) {
  HumanRemover remover{HumanRemovalConfig()};
  const auto cuts = CutFrames(remover, 20, [](int i) {
    return i < 4 ? kOnTime(i) : std::vector<Skeletons>{MovingPerson().NobodyAt(i)};
  });
  ExpectFound(cuts[12], 12);
  EXPECT_EQ(cv::countNonZero(cuts.back().mask), 0);
  EXPECT_EQ(cuts.back().num_people, 0);
}

TEST(HumanRemover, PolicyPassCutsOnlyWithOwnKeypoints) {
  HumanRemovalConfig config;
  config.policy = KeypointPolicy::kPass;
  HumanRemover remover{config};
  const auto cuts = CutFrames(
      remover, 4, [](int i) { return i % 2 == 0 ? kOnTime(i) : std::vector<Skeletons>(); });
  EXPECT_GT(cv::countNonZero(cuts[2].mask), 0);
  EXPECT_EQ(cv::countNonZero(cuts[3].mask), 0);
  remover.Follow(MovingPerson().FrameAt(4));
  const HumanCut late = remover.Process(MovingPerson().FrameAt(5), kOnTime(3));
  EXPECT_EQ(cv::countNonZero(late.mask), 0);
  EXPECT_NEAR(*late.mask_age_s, 3 * 0.033, 1e-6) << "of the keypoints that were used";
  EXPECT_EQ(remover.counts().unmatched, 1);
}

TEST(HumanRemover, CountsKeypointsOfFramesThatNeverCame) {
  HumanRemover remover{HumanRemovalConfig()};
  CutFrames(remover, 3, [](int i) { return kOnTime(i + 100); });
  EXPECT_EQ(remover.counts().used, 0);
  EXPECT_EQ(remover.counts().unmatched, 3);
}

TEST(HumanRemover, GivesTheSameMasksAgain) {
  HumanRemover a{HumanRemovalConfig()};
  HumanRemover b{HumanRemovalConfig()};
  CutFrames(b, 3, kOnTime);
  b.Reset();
  const auto first = CutFrames(a, 8, kOnTime);
  const auto second = CutFrames(b, 8, kOnTime);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(cv::countNonZero(first[i].mask != second[i].mask), 0) << i;
  }
}

TEST(HumanRemover, RefusesFramesOutOfOrderAndGoesOn) {
  HumanRemover remover{HumanRemovalConfig()};
  CutFrames(remover, 3, kOnTime);
  EXPECT_THROW(remover.Process(MovingPerson().FrameAt(1), {}), std::invalid_argument);
  ExpectFound(remover.Process(MovingPerson().FrameAt(3), kOnTime(3)), 3);
}

TEST(HumanRemover, NamesTheKeyThatIsOutOfRange) {
  HumanRemovalConfig config;
  config.hold.gain = 2;
  try {
    HumanRemover remover{config};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("human_removal.hold.gain"), std::string::npos);
  }
}

TEST(HumanRemover, CutsLateKeypointsWithTheGravityOfTheirFrame) {
  HumanRemover remover{HumanRemovalConfig()};
  const Eigen::Vector3f then = Eigen::Vector3f::UnitX();
  remover.Process(MovingPerson().FrameAt(0), {}, then);
  Skeletons late = MovingPerson().SkeletonsAt(0);
  for (const CocoJoint joint : {kRightKnee, kLeftKnee, kRightAnkle, kLeftAnkle}) {
    late.people[0][joint] = {};
  }
  remover.Process(MovingPerson().FrameAt(1), {late}, Eigen::Vector3f(-then));
  ASSERT_EQ(remover.seeds().size(), 1U);
  const PersonSeeds expected =
      LiftPerson(late.people[0], MovingPerson().FrameAt(0), HumanRemovalConfig().seeds, then);
  const std::vector<UnseenPart>& parts = remover.seeds()[0].unseen_parts;
  ASSERT_FALSE(parts.empty());
  ASSERT_EQ(parts.size(), expected.unseen_parts.size());
  EXPECT_EQ(parts.back().p_camera, expected.unseen_parts.back().p_camera);
}

}  // namespace
}  // namespace posefusion
