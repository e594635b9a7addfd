#include "posefusion/skeleton/skeleton_buffer.h"

#include <gtest/gtest.h>

#include "test/skeleton/sample_skeletons.h"

namespace posefusion {
namespace {

constexpr StampNs kSecond = 1'000'000'000;

Skeletons PeopleAt(StampNs stamp_ns, std::size_t count) {
  Skeletons skeletons;
  skeletons.stamp_ns = stamp_ns;
  skeletons.people.resize(count);
  return skeletons;
}

TEST(SkeletonBuffer, FindsByStampWhateverTheOrder) {
  SkeletonBuffer buffer(10);
  buffer.Add(PeopleAt(2 * kSecond, 2));
  buffer.Add(PeopleAt(1 * kSecond, 1));
  ASSERT_TRUE(buffer.Find(kSecond));
  EXPECT_EQ(buffer.Find(kSecond)->people.size(), 1U);
  EXPECT_EQ(buffer.Find(2 * kSecond + 900)->people.size(), 2U) << "stamps of fewer digits";
  EXPECT_FALSE(buffer.Find(kSecond + 2 * kSameImageNs));
  EXPECT_FALSE(buffer.Find(3 * kSecond));
}

TEST(SkeletonBuffer, NobodySeenIsFoundToo) {
  SkeletonBuffer buffer(10);
  EXPECT_FALSE(buffer.Find(kSecond));
  buffer.Add(PeopleAt(kSecond, 0));
  ASSERT_TRUE(buffer.Find(kSecond));
  EXPECT_TRUE(buffer.Find(kSecond)->people.empty());
}

TEST(SkeletonBuffer, OldestMakesRoomAndEqualStampsReplace) {
  SkeletonBuffer buffer(2);
  buffer.Add(PeopleAt(1 * kSecond, 1));
  buffer.Add(PeopleAt(1 * kSecond, 3));
  EXPECT_EQ(buffer.Find(kSecond)->people.size(), 3U);
  buffer.Add(PeopleAt(2 * kSecond, 1));
  buffer.Add(PeopleAt(3 * kSecond, 1));
  EXPECT_EQ(buffer.size(), 2U);
  EXPECT_FALSE(buffer.Find(kSecond));
  EXPECT_TRUE(buffer.Find(3 * kSecond));
}

}  // namespace
}  // namespace posefusion
