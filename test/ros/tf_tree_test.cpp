#include "posefusion_ros/tf_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "test/ros/robot_tf.h"

namespace posefusion {
namespace {

using testing::ElementsAre;

constexpr StampNs kSecondNs = 1'000'000'000;
constexpr double kJumpBackS = 0.5;

Eigen::Isometry3d Shift(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)); }

class TfTreeTest : public testing::Test {
 protected:
  void Add(const std::string& parent, const std::string& child, double time_s, double x,
           const std::string& publisher = "/somebody") {
    tree_.Add(MakeTransform(parent, child, StampFromSeconds(time_s), Shift(x)), publisher, false);
  }
  double FindX(const std::string& target, const std::string& source, double time_s) {
    const auto T = tree_.Find(target, source, StampFromSeconds(time_s));
    return T ? T->translation().x() : NAN;
  }

  TfTree tree_{kJumpBackS};
};

TEST_F(TfTreeTest, InterpolatesAndNeverExtrapolates) {
  Add("a", "b", 100, 1);
  Add("a", "b", 101, 2);
  EXPECT_DOUBLE_EQ(FindX("a", "b", 100.25), 1.25);
  EXPECT_DOUBLE_EQ(FindX("b", "a", 100.25), -1.25);
  EXPECT_TRUE(std::isnan(FindX("a", "b", 99.99)));
  EXPECT_TRUE(std::isnan(FindX("a", "b", 101.01)));
}

TEST_F(TfTreeTest, KeepsWhatFramesThatWaitWillAskFor) {
  for (double time_s = 100; time_s <= 160; time_s += 0.1) Add("a", "b", time_s, time_s);
  EXPECT_NEAR(FindX("a", "b", 100.25), 100.25, 1e-6);
}

TEST_F(TfTreeTest, NamesMayBeginWithASlash) {
  Add("/a", "/real/b", 100, 1);
  EXPECT_DOUBLE_EQ(FindX("a", "real/b", 100), 1);
  EXPECT_DOUBLE_EQ(FindX("/a", "/real/b", 100), 1);
  EXPECT_DOUBLE_EQ(FindX("/unknown", "unknown", 100), 0) << "every frame lies on itself";
}

TEST_F(TfTreeTest, TellsWhoHoldsAFrameAndTheWayToTheRoot) {
  Add("a", "b", 100, 1, "/one");
  Add("b", "c", 100, 1, "/two");
  EXPECT_EQ(tree_.LinkOf("c")->parent, "b");
  EXPECT_EQ(tree_.LinkOf("/c")->publisher, "/two");
  EXPECT_FALSE(tree_.LinkOf("a"));
  EXPECT_THAT(tree_.ChainOf("c"), ElementsAre("c", "b", "a"));
  EXPECT_THAT(tree_.ChainOf("unknown"), ElementsAre("unknown"));
}

TEST_F(TfTreeTest, LoopsAndBrokenTransformsGiveNothing) {
  Add("a", "b", 100, 1);
  Add("b", "c", 100, 1);
  Add("c", "a", 100, 1);
  EXPECT_TRUE(std::isnan(FindX("root", "a", 100)));
  EXPECT_EQ(tree_.ChainOf("a").size(), 3U);
  EXPECT_NE(tree_.WhyNot("root", "a", StampFromSeconds(100)), "");
  Add("d", "e", 100, NAN);
  EXPECT_TRUE(std::isnan(FindX("d", "e", 100)));
  EXPECT_FALSE(tree_.LinkOf("e"));
  Add("", "f", 100, 1);
  EXPECT_FALSE(tree_.LinkOf("f"));
}

TEST_F(TfTreeTest, SaysInSteadyWordsWhyThereIsNothing) {
  Add("a", "b", 100, 1);
  Add("a", "b", 101, 1);
  Add("x", "y", 100, 1);
  const auto why = [&](const char* target, const char* source, double time_s) {
    return tree_.WhyNot(target, source, StampFromSeconds(time_s));
  };
  EXPECT_EQ(why("a", "b", 100.5), "");
  EXPECT_THAT(why("a", "b", 102), testing::HasSubstr("other times"));
  EXPECT_EQ(why("a", "b", 102), why("a", "b", 103));
  EXPECT_THAT(why("a", "y", 100), testing::HasSubstr("nothing connects"));
  EXPECT_THAT(why("nowhere", "nobody", 100), testing::HasSubstr("nobody publishes"));
}

TEST_F(TfTreeTest, ARestartedBagIsFollowedAndStaticFramesStay) {
  tree_.Add(MakeTransform("b", "fixed", 0, Shift(5)), "/somebody", true);
  Add("a", "b", 1000, 1);
  Add("a", "b", 1001, 2);
  Add("a", "b", 100, 7);  // without forgetting, tf2 would throw this away as too old
  EXPECT_DOUBLE_EQ(FindX("a", "fixed", 100), 12);
  EXPECT_TRUE(std::isnan(FindX("a", "b", 1000.5)));
}

TEST_F(TfTreeTest, LateOnesAreNoRestart) {
  Add("a", "b", 100, 1);
  Add("a", "b", 100.2, 3);
  Add("a", "b", 100.1, 2);
  EXPECT_DOUBLE_EQ(FindX("a", "b", 100.05), 1.5);
}

TEST_F(TfTreeTest, WaitsForWhatIsOnItsWay) {
  std::thread sender([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    Add("a", "b", 100, 4);
  });
  const auto T = tree_.WaitFor("a", "b", 100 * kSecondNs, 5);
  sender.join();
  ASSERT_TRUE(T);
  EXPECT_DOUBLE_EQ(T->translation().x(), 4);
  EXPECT_FALSE(tree_.WaitFor("a", "b", 101 * kSecondNs, 0.01));
}

}  // namespace
}  // namespace posefusion
