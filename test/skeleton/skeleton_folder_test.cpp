#include "posefusion/skeleton/skeleton_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "test/skeleton/sample_skeletons.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

using ::testing::ElementsAre;
using testing::FrameAt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::PersonAt;
using ::testing::ThrowsMessage;
using testing::WritePeople;
using testing::WriteText;

constexpr StampNs kSecond = 1'000'000'000;

class SkeletonFolderTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(SkeletonFolderTest, NoFileAndNobodySeenAreDifferent) {
  WritePeople(folder_ / "1.0.json", {PersonAt(10, 20)});
  WritePeople(folder_ / "3.0.json", {});
  SkeletonFolder source(folder_.path());
  source.Offer(FrameAt(1 * kSecond));
  const auto somebody = source.Take(1 * kSecond);
  ASSERT_EQ(somebody.size(), 1U);
  EXPECT_EQ(somebody[0].stamp_ns, 1 * kSecond);
  EXPECT_EQ(somebody[0].arrival_ns, 1 * kSecond);
  EXPECT_EQ(somebody[0].people.size(), 1U);
  source.Offer(FrameAt(2 * kSecond));
  EXPECT_TRUE(source.Take(2 * kSecond).empty());
  source.Offer(FrameAt(3 * kSecond));
  const auto nobody = source.Take(3 * kSecond);
  ASSERT_EQ(nobody.size(), 1U);
  EXPECT_TRUE(nobody[0].people.empty());
  EXPECT_THAT(source.TakeNotes(), IsEmpty());
}

TEST_F(SkeletonFolderTest, StampsOfFewerDigitsBelongToTheNearestImage) {
  WritePeople(folder_ / "1305031102.1753.json", {PersonAt(10, 20)});
  SkeletonFolder source(folder_.path());
  const StampNs stamp_ns = 1'305'031'102'175'304'000;
  source.Offer(FrameAt(stamp_ns));
  const auto taken = source.Take(stamp_ns);
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].stamp_ns, stamp_ns) << "that of the image";
  source.Offer(FrameAt(stamp_ns + 2 * kSameImageNs));
  EXPECT_TRUE(source.Take(2 * stamp_ns).empty());
}

TEST_F(SkeletonFolderTest, NumberedFilesFollowTheIndexOfTheImage) {
  WritePeople(folder_ / "walk_000000000004_keypoints.json", {PersonAt(40, 20)});
  WritePeople(folder_ / "walk_000000000005_keypoints.json", {PersonAt(50, 20)});
  SkeletonFolder source(folder_.path());
  source.Offer(FrameAt(100 * kSecond, 5));
  const auto taken = source.Take(100 * kSecond);
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].people.at(0)[0].u, 50);
  source.Offer(FrameAt(101 * kSecond, -1));
  EXPECT_TRUE(source.Take(101 * kSecond).empty());
}

TEST_F(SkeletonFolderTest, LateKeypointsComeInTheOrderOfTheirArrival) {
  for (const char* name : {"1.0.json", "2.0.json", "3.0.json"}) WritePeople(folder_ / name, {});
  WriteText(folder_ / "arrival.txt", "# stamp arrival_stamp\n1.000000 4.5\n2.0 3.0\n");
  SkeletonFolder source(folder_.path());
  std::vector<StampNs> stamps;
  const auto take = [&](StampNs now_ns) {
    stamps.clear();
    for (const Skeletons& skeletons : source.Take(now_ns)) stamps.push_back(skeletons.stamp_ns);
    return stamps;
  };
  source.Offer(FrameAt(1 * kSecond));
  EXPECT_THAT(take(1 * kSecond), IsEmpty());
  source.Offer(FrameAt(2 * kSecond));
  EXPECT_THAT(take(2 * kSecond), IsEmpty());
  source.Offer(FrameAt(3 * kSecond));
  EXPECT_THAT(take(3 * kSecond), ElementsAre(2 * kSecond, 3 * kSecond));
  EXPECT_THAT(take(4 * kSecond), IsEmpty());
  EXPECT_THAT(take(5 * kSecond), ElementsAre(1 * kSecond));
}

TEST_F(SkeletonFolderTest, BadFilesAreNamedAndTheRestGoesOn) {
  WriteText(folder_ / "1.0.json", "{\"people\":[");
  WriteText(folder_ / "2.0.json", std::string(kMaxOpenPoseBytes + 1, ' '));
  WritePeople(folder_ / "3.0.json", {PersonAt(10, 20)});
  SkeletonFolder source(folder_.path());
  for (const StampNs second : {1, 2}) {
    const std::string name = folder_ / (std::to_string(second) + ".0.json");
    EXPECT_THAT([&] { source.Offer(FrameAt(second * kSecond)); },
                ThrowsMessage<std::runtime_error>(HasSubstr(name)));
    EXPECT_TRUE(source.Take(second * kSecond).empty());
  }
  source.Offer(FrameAt(3 * kSecond));
  EXPECT_EQ(source.Take(3 * kSecond).size(), 1U);
}

TEST_F(SkeletonFolderTest, JointsOutsideTheImageAreNotFound) {
  WritePeople(folder_ / "1.0.json", {PersonAt(635, 20), PersonAt(900, 20)});
  SkeletonFolder source(folder_.path());
  source.Offer(FrameAt(1 * kSecond));
  const auto taken = source.Take(1 * kSecond);
  ASSERT_EQ(taken.at(0).people.size(), 1U);
  EXPECT_GT(taken[0].people[0][4].p, 0);
  EXPECT_EQ(taken[0].people[0][5].p, 0);
}

TEST_F(SkeletonFolderTest, TooManyPeopleAreToldOnce) {
  const std::vector<Skeleton> crowd(20, PersonAt(10, 20));
  WritePeople(folder_ / "1.0.json", crowd);
  WritePeople(folder_ / "2.0.json", crowd);
  SkeletonFolder source(folder_.path());
  source.Offer(FrameAt(1 * kSecond));
  EXPECT_THAT(source.TakeNotes(), ElementsAre(HasSubstr("more than 15 people")));
  source.Offer(FrameAt(2 * kSecond));
  EXPECT_THAT(source.TakeNotes(), IsEmpty());
  EXPECT_EQ(source.Take(2 * kSecond).at(1).people.size(), 15U);
}

TEST_F(SkeletonFolderTest, AnotherClockIsToldOnceWithBothStamps) {
  WritePeople(folder_ / "0.5.json", {});
  WritePeople(folder_ / "0.6.json", {});
  SkeletonFolder source(folder_.path());
  source.Offer(FrameAt(1'305'031'102 * kSecond));
  const auto notes = source.TakeNotes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("0.600000"));
  EXPECT_THAT(notes[0], HasSubstr("1305031102.000000"));
  source.Offer(FrameAt(1'305'031'103 * kSecond));
  EXPECT_THAT(source.TakeNotes(), IsEmpty());
}

TEST_F(SkeletonFolderTest, CountsKeypointsWithoutFrames) {
  for (const char* name : {"1.0.json", "2.0.json", "3.0.json"}) WritePeople(folder_ / name, {});
  SkeletonFolder source(folder_.path());
  source.Offer(FrameAt(1 * kSecond));
  source.Offer(FrameAt(7 * kSecond));
  EXPECT_EQ(source.counts().frames_with_keypoints, 1);
  EXPECT_EQ(source.counts().without_frame, 2);
  EXPECT_THAT(source.TakeNotes(), IsEmpty());
}

TEST_F(SkeletonFolderTest, EmptyFolderIsTold) {
  SkeletonFolder source(folder_.path());
  EXPECT_THAT(source.TakeNotes(), ElementsAre(HasSubstr("no keypoint files")));
}

TEST_F(SkeletonFolderTest, ReadsRecordedKeypoints) {
  SKIP_WITHOUT_DATA("fr1_xyz_people/keypoints");
  SkeletonFolder source(DataPath("fr1_xyz_people/keypoints"));
  const int num_files = source.counts().without_frame;
  EXPECT_GT(num_files, 100);
  std::size_t num_people = 0;
  for (const auto& [stamp_ns, path] :
       ListKeypointFiles(DataPath("fr1_xyz_people/keypoints")).paths) {
    source.Offer(FrameAt(stamp_ns));
    for (const Skeletons& skeletons : source.Take(stamp_ns)) num_people += skeletons.people.size();
  }
  EXPECT_GT(num_people, 50U);
  EXPECT_EQ(source.counts().frames_with_keypoints, num_files);
  EXPECT_THAT(source.TakeNotes(), IsEmpty());
}

}  // namespace
}  // namespace posefusion
