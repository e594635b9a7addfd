#include "posefusion_ros/bounded_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace posefusion {
namespace {

constexpr std::chrono::milliseconds kNoWait(0);
constexpr std::chrono::seconds kLong(60);

TEST(BoundedQueue, DropsTheOldestWhenFullAndCountsIt) {
  BoundedQueue<int> queue(2);
  for (int i = 0; i < 5; ++i) queue.Push(i);
  EXPECT_EQ(queue.num_dropped(), 3U);
  EXPECT_EQ(queue.PopFor(kNoWait), 3);
  EXPECT_EQ(queue.PopFor(kNoWait), 4);
  EXPECT_EQ(queue.PopFor(kNoWait), std::nullopt);
}

TEST(BoundedQueue, SmallerCapacityCountsFromTheNextItem) {
  BoundedQueue<int> queue(5);
  for (int i = 0; i < 5; ++i) queue.Push(i);
  queue.SetCapacity(2);
  EXPECT_EQ(queue.size(), 5U);
  queue.Push(5);
  EXPECT_EQ(queue.num_dropped(), 4U);
  EXPECT_EQ(queue.PopFor(kNoWait), 4);
  EXPECT_EQ(queue.PopFor(kNoWait), 5);
}

TEST(BoundedQueue, ShrinksByOneAtATimeAndToWhatWaits) {
  BoundedQueue<int> queue(10);
  for (int i = 0; i < 6; ++i) queue.Push(i);
  for (const std::size_t left : {6U, 5U, 4U, 3U, 2U, 2U}) {
    queue.ShrinkCapacity(2);
    queue.Push(0);
    EXPECT_EQ(queue.size(), left);
  }
}

TEST(BoundedQueue, ShrinkingLeavesAQueueWithoutBoundAlone) {
  BoundedQueue<int> queue(0);
  queue.ShrinkCapacity(1);
  for (int i = 0; i < 5; ++i) queue.Push(i);
  EXPECT_EQ(queue.size(), 5U);
}

TEST(BoundedQueue, WhatIsPushedIfThereIsRoomDropsNothingAndIsNotMissed) {
  BoundedQueue<int> queue(1);
  queue.PushIfRoom(1);
  queue.PushIfRoom(2);
  EXPECT_EQ(queue.size(), 1U);
  queue.Push(3);
  EXPECT_EQ(queue.num_dropped(), 0U);
  EXPECT_EQ(queue.PopFor(kNoWait), 3);
}

TEST(BoundedQueue, WithoutBoundNothingIsDropped) {
  BoundedQueue<int> queue(0);
  for (int i = 0; i < 1000; ++i) queue.Push(i);
  EXPECT_EQ(queue.size(), 1000U);
  EXPECT_EQ(queue.num_dropped(), 0U);
}

TEST(BoundedQueue, CloseEndsWaitingAndForgetsTheRest) {
  BoundedQueue<int> queue(2);
  std::thread waiter([&] { EXPECT_EQ(queue.PopFor(kLong), std::nullopt); });
  queue.Close();
  waiter.join();
  queue.Push(1);
  EXPECT_EQ(queue.size(), 0U);
}

TEST(BoundedQueue, HandsItemsToAWaitingThread) {
  BoundedQueue<int> queue(2);
  std::thread waiter([&] { EXPECT_EQ(queue.PopFor(kLong), 7); });
  queue.Push(7);
  waiter.join();
}

}  // namespace
}  // namespace posefusion
