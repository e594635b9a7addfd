#include "posefusion/common/task_thread.h"

#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <stdexcept>

namespace posefusion {
namespace {

using testing::ElementsAre;
using testing::ThrowsMessage;

TEST(TaskThreadTest, RunsTasksInTheirOrder) {
  std::vector<int> done;
  TaskThread thread(2);
  for (int i = 0; i < 5; ++i) thread.Add([&done, i] { done.push_back(i); });
  thread.Finish();
  EXPECT_THAT(done, ElementsAre(0, 1, 2, 3, 4));
}

TEST(TaskThreadTest, AddReturnsWhileAnEarlierTaskStillRuns) {
  std::promise<void> gate;
  TaskThread thread(1);
  thread.Add([&] { gate.get_future().wait(); });
  gate.set_value();
  thread.Finish();
}

TEST(TaskThreadTest, AnErrorComesOutOfTheNextCallsAndEndsTheWork) {
  std::atomic<bool> ran_later{false};
  TaskThread thread(4);
  std::promise<void> gate;
  auto opened = gate.get_future().share();
  thread.Add([opened] {
    opened.wait();
    throw std::runtime_error("disk full");
  });
  thread.Add([&] { ran_later = true; });
  gate.set_value();
  const auto disk_full = ThrowsMessage<std::runtime_error>("disk full");
  EXPECT_THAT([&] { thread.Finish(); }, disk_full);
  EXPECT_THAT([&] { thread.Add([] {}); }, disk_full);
  EXPECT_THAT([&] { thread.Finish(); }, disk_full);
  EXPECT_FALSE(ran_later);
}

TEST(TaskThreadTest, AddDoesNotWaitForRoomAfterAnError) {
  TaskThread thread(1);
  const auto fill = [&] {
    for (int i = 0; i < 10; ++i) thread.Add([] { throw std::runtime_error("disk full"); });
  };
  EXPECT_THROW(fill(), std::runtime_error);
}

TEST(TaskThreadTest, DestructionWaitsForTheTaskThatRuns) {
  std::atomic<bool> done{false};
  std::promise<void> started;
  {
    TaskThread thread(1);
    thread.Add([&] {
      started.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      done = true;
    });
    started.get_future().wait();
  }
  EXPECT_TRUE(done);
}

TEST(TaskThreadTest, RefusesACapacityBelowOne) {
  EXPECT_THROW(TaskThread(0), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
