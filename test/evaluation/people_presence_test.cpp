#include "posefusion/evaluation/people_presence.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr StampNs kSecond = 1'000'000'000;

TEST(PeoplePresence, CapsuleIsALineWithARadius) {
  const PersonCapsule arm{0, 0, {0, 0, 0}, {1, 0, 0}, 0.1F};
  EXPECT_TRUE(IsInside(arm, {0.5F, 0.09F, 0}));
  EXPECT_FALSE(IsInside(arm, {0.5F, 0.11F, 0}));
  EXPECT_TRUE(IsInside(arm, {1.09F, 0, 0}));
  EXPECT_FALSE(IsInside(arm, {1.09F, 0.09F, 0}));
  const PersonCapsule head{0, 0, {1, 1, 1}, {1, 1, 1}, 0.1F};
  EXPECT_TRUE(IsInside(head, {1, 1, 1.09F}));
  EXPECT_FALSE(IsInside(head, {1, 1, 1.11F}));
}

TEST(PeoplePresence, KnowsWhoWasWhereWhen) {
  const PersonCapsule before{1, 0, {0, 0, 0}, {0, 0, 2}, 0.2F};
  const PersonCapsule after{1, 0, {3, 0, 0}, {3, 0, 2}, 0.2F};
  const PeoplePresence people({{10 * kSecond, {before}}, {12 * kSecond, {after}}}, 0.05);
  EXPECT_TRUE(people.WasAt({0, 0.24F, 1}, 9 * kSecond, 11 * kSecond));
  EXPECT_FALSE(people.WasAt({0, 0.26F, 1}, 9 * kSecond, 11 * kSecond));
  EXPECT_FALSE(people.WasAt({0, 0, 1}, 11 * kSecond, 13 * kSecond));
  EXPECT_TRUE(people.WasAt({3, 0, 1}, 12 * kSecond + 10'000'000, 13 * kSecond));
  EXPECT_FALSE(people.WasAt({3, 0, 1}, 0, 1 * kSecond));
  EXPECT_FALSE(PeoplePresence({}, 0.05).WasAt({0, 0, 0}, 0, 100 * kSecond));
}

}  // namespace
}  // namespace posefusion
