#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "posefusion_ros/topic_watchdog.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(TroubleLog, TellsNewTroubleAtOnceAndRepeatsRarely) {
  std::vector<std::string> errors;
  std::vector<std::string> infos;
  TroubleLog log(
      5, [&](const std::string& text) { errors.push_back(text); },
      [&](const std::string& text) { infos.push_back(text); });
  for (int i = 0; i < 100; ++i) log.Report("bad encoding", 0.03 * i);
  EXPECT_EQ(errors.size(), 1U);
  log.Report("bad size", 3.1);
  EXPECT_EQ(errors.size(), 2U);
  log.Report("bad size", 9);
  EXPECT_EQ(errors.size(), 3U);
  EXPECT_EQ(log.trouble(), "bad size");
  log.AllWell();
  log.AllWell();
  EXPECT_EQ(infos.size(), 1U);
  EXPECT_EQ(log.trouble(), "");
}

TEST(TopicWatchdog, NamesTheSilentTopics) {
  TopicWatchdog watchdog({"/rgb", "/depth", "/info"}, 5, 0);
  for (int second = 0; second < 5; ++second) watchdog.NoteMessage(0, second);
  EXPECT_FALSE(watchdog.Complaint(4.9, {}));
  watchdog.NoteMessage(0, 5);
  const auto complaint = watchdog.Complaint(5, {});
  ASSERT_TRUE(complaint);
  EXPECT_THAT(*complaint, HasSubstr("/depth (nothing ever came)"));
  EXPECT_THAT(*complaint, Not(HasSubstr("/rgb")));
  EXPECT_FALSE(watchdog.Complaint(9.9, {})) << "not again so soon";
  EXPECT_TRUE(watchdog.Complaint(10, {}));
  EXPECT_FALSE(watchdog.Complaint(19, {})) << "rarer and rarer";
  watchdog.NoteFrame(20);
  EXPECT_TRUE(watchdog.Complaint(25, {}));
}

TEST(TopicWatchdog, NamesTopicsThatStopAMomentAfterTheLastFrame) {
  TopicWatchdog watchdog({"/rgb", "/depth"}, 5, 0);
  watchdog.NoteFrame(10);
  watchdog.NoteMessage(0, 10.03);
  watchdog.NoteMessage(1, 10.02);
  EXPECT_THAT(watchdog.Complaint(15, {}).value_or(""), HasSubstr("/rgb (silent for 5 s), /depth"));
}

TEST(TopicWatchdog, TellsThatStampsDoNotFit) {
  TopicWatchdog watchdog({"/rgb", "/depth"}, 5, 0);
  watchdog.NoteMessage(0, 6);
  watchdog.NoteMessage(1, 6);
  EXPECT_THAT(watchdog.Complaint(7, 0.033).value_or(""), HasSubstr("33 ms apart"));
}

TEST(TopicWatchdog, IsQuietWhileFramesCome) {
  TopicWatchdog watchdog({"/rgb", "/depth"}, 5, 0);
  watchdog.NoteFrame(99);
  EXPECT_FALSE(watchdog.Complaint(100, {}));
}

}  // namespace
}  // namespace posefusion
