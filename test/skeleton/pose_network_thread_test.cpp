#include "posefusion/skeleton/pose_network_thread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <future>
#include <stdexcept>

namespace posefusion {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr StampNs kSecond = 1'000'000'000;
constexpr std::chrono::seconds kLong{20};  ///< for what is due at once on a busy machine

cv::Mat Picture(int number) { return {4, 4, CV_8UC3, cv::Scalar::all(number)}; }

int NumberOf(const cv::Mat& picture) { return picture.at<cv::Vec3b>(0, 0)[0]; }

/// What came out of a thread, in order.
class Outcome {
 public:
  PoseNetworkThreadHooks Hooks() {
    return {[this](const Skeletons& skeletons) { Add(FormatStamp(skeletons.stamp_ns)); },
            [this](const std::string& text) { Add(text); }};
  }

  /// Everything, once there is so much of it.
  std::vector<std::string> WaitFor(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    added_.wait_for(lock, kLong, [&] { return entries_.size() >= count; });
    return entries_;
  }

 private:
  void Add(const std::string& entry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries_.push_back(entry);
    added_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable added_;
  std::vector<std::string> entries_;
};

/// A detector that is busy with its first image until it is let go.
class BusyDetector {
 public:
  std::vector<Skeleton> operator()(const cv::Mat&) {
    if (first_) {
      first_ = false;
      started_.set_value();
      go_.get_future().wait();
    }
    return {};
  }
  void WaitUntilBusy() { started_.get_future().wait(); }
  void LetGo() { go_.set_value(); }

 private:
  bool first_ = true;
  std::promise<void> started_;
  std::promise<void> go_;
};

TEST(PoseNetworkThread, NewestImageWinsWhileTheNetworkIsBusyAndNobodyWaits) {
  BusyDetector busy;
  Outcome outcome;
  PoseNetworkThread thread(std::ref(busy), {}, outcome.Hooks());
  thread.Offer(1 * kSecond, Picture(1));
  busy.WaitUntilBusy();
  for (int i = 2; i <= 9; ++i) thread.Offer(i * kSecond, Picture(i));  // returns while it is busy
  busy.LetGo();
  EXPECT_THAT(outcome.WaitFor(2), ElementsAre("1.000000", "9.000000"));
}

TEST(PoseNetworkThread, GivesPeopleWithTheStampOfTheirImage) {
  std::promise<Skeletons> result;
  PoseNetworkThreadHooks hooks;
  hooks.on_skeletons = [&](const Skeletons& skeletons) { result.set_value(skeletons); };
  const auto detector = [](const cv::Mat& rgb) {
    Skeleton person{};
    person[kNeck] = {static_cast<float>(NumberOf(rgb)), 2, 1};
    return std::vector<Skeleton>{person};
  };
  PoseNetworkThread thread(detector, {}, hooks);
  thread.Offer(7 * kSecond, Picture(42));
  const Skeletons skeletons = result.get_future().get();
  EXPECT_EQ(skeletons.stamp_ns, 7 * kSecond);
  ASSERT_EQ(skeletons.people.size(), 1U);
  EXPECT_EQ(skeletons.people[0][kNeck].u, 42);
}

TEST(PoseNetworkThread, ReportsAFailureWithTheStampAndGoesOn) {
  Outcome outcome;
  const auto detector = [](const cv::Mat& rgb) -> std::vector<Skeleton> {
    if (NumberOf(rgb) == 1) throw std::runtime_error("no such layer");
    if (NumberOf(rgb) == 2) throw 3;
    return {};
  };
  PoseNetworkThread thread(detector, {}, outcome.Hooks());
  for (int i = 1; i <= 3; ++i) {
    thread.Offer(i * kSecond, Picture(i));
    outcome.WaitFor(static_cast<std::size_t>(i));
  }
  EXPECT_THAT(outcome.WaitFor(3), ElementsAre("image 1.000000: no such layer",
                                              "image 2.000000: unknown error", "3.000000"));
}

TEST(PoseNetworkThread, LooksAtNoMoreImagesThanItsRateByTheirStamps) {
  Outcome outcome;
  PoseNetworkConfig config;
  config.rate_hz = 2;
  PoseNetworkThread thread([](const cv::Mat&) { return std::vector<Skeleton>(); }, config,
                           outcome.Hooks());
  std::size_t expected = 0;
  for (int i = 0; i < 12; ++i) {  // 8 Hz
    thread.Offer(kSecond + i * kSecond / 8, Picture(0));
    if (i % 4 == 0) outcome.WaitFor(++expected);
  }
  EXPECT_THAT(outcome.WaitFor(3), ElementsAre("1.000000", "1.500000", "2.000000"));
}

TEST(PoseNetworkThread, RunsAtALowerPriorityThanItsCaller) {
  const int own = getpriority(PRIO_PROCESS, 0);
  std::promise<int> niceness;
  PoseNetworkConfig config;
  config.niceness = 19;
  PoseNetworkThread thread(
      [&](const cv::Mat&) {
        niceness.set_value(getpriority(PRIO_PROCESS, 0));
        return std::vector<Skeleton>();
      },
      config, {});
  thread.Offer(kSecond, Picture(0));
  EXPECT_EQ(niceness.get_future().get(), 19);
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), own);
}

TEST(PoseNetworkThread, EndsWithAnImageStillWaiting) {
  BusyDetector busy;
  auto thread = std::make_unique<PoseNetworkThread>(std::ref(busy), PoseNetworkConfig(),
                                                    PoseNetworkThreadHooks());
  thread->Offer(1 * kSecond, Picture(1));
  busy.WaitUntilBusy();
  thread->Offer(2 * kSecond, Picture(2));
  auto ended = std::async(std::launch::async, [&] { thread.reset(); });
  busy.LetGo();
  EXPECT_EQ(ended.wait_for(kLong), std::future_status::ready);
}

TEST(PoseNetworkThread, RefusesAPriorityThatDoesNotExist) {
  PoseNetworkConfig config;
  config.niceness = 20;
  EXPECT_THAT([&] { PoseNetworkThread thread({}, config, {}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("pose_network.niceness")));
}

}  // namespace
}  // namespace posefusion
