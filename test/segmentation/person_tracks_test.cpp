#include "posefusion/segmentation/person_tracks.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

TEST(PersonTracks, NobodyIsMissedBeforeNewerKeypointsCame) {
  PersonTracks tracks{PersonHoldConfig()};
  const CellPerson person = *tracks.Add(1.0);
  tracks.NoteKeypoints(1.0);
  EXPECT_TRUE(tracks.Holds(person));
}

TEST(PersonTracks, HoldsLongerWhoeverWasSeenLonger) {
  PersonHoldConfig config;
  PersonTracks tracks{config};
  const CellPerson brief = *tracks.Add(0);
  const CellPerson known = *tracks.Add(0);
  tracks.Confirm(known, 1.0, 0);
  tracks.Confirm(brief, 0.0, 0);
  tracks.NoteKeypoints(config.min_hold_s + 0.01);
  EXPECT_FALSE(tracks.Holds(brief));
  tracks.NoteKeypoints(2.0);
  EXPECT_TRUE(tracks.Holds(known));
  tracks.NoteKeypoints(1.0 + config.max_hold_s + 0.01);
  EXPECT_FALSE(tracks.Holds(known));
}

TEST(PersonTracks, HoldsWhoeverShowedManyCertainJointsForAMoment) {
  PersonHoldConfig config;
  PersonTracks tracks{config};
  const CellPerson certain = *tracks.Add(0);
  const CellPerson uncertain = *tracks.Add(0);
  tracks.Confirm(certain, 0, config.min_certain_joints);
  tracks.Confirm(uncertain, 0, config.min_certain_joints - 1);
  tracks.NoteKeypoints(config.min_hold_s + 0.01);
  EXPECT_TRUE(tracks.Holds(certain));
  EXPECT_FALSE(tracks.Holds(uncertain));
  tracks.NoteKeypoints(config.certain_hold_s + 0.01);
  EXPECT_FALSE(tracks.Holds(certain));
}

TEST(PersonTracks, TwoMissedImagesAtFiveHertzAreNoReasonToForget) {
  const PersonHoldConfig config;
  PersonTracks tracks{config};
  const CellPerson person = *tracks.Add(0.2);
  tracks.Confirm(person, 0.2, config.min_certain_joints);
  tracks.NoteKeypoints(0.6);
  EXPECT_TRUE(tracks.Holds(person));
  tracks.NoteKeypoints(0.8);
  EXPECT_FALSE(tracks.Holds(person));
}

TEST(PersonTracks, NumbersRunOutWithoutHarm) {
  PersonTracks tracks{PersonHoldConfig()};
  for (int i = 0; i < kMaxPersonNumber; ++i) EXPECT_TRUE(tracks.Add(0));
  EXPECT_FALSE(tracks.Add(0));
  tracks.Forget(7);
  EXPECT_EQ(tracks.Add(0), 7);
}

}  // namespace
}  // namespace posefusion
