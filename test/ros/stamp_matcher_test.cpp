#include "posefusion_ros/stamp_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "posefusion/common/association.h"

namespace posefusion {
namespace {

using Stamps = std::vector<StampNs>;
using Pairs = std::vector<std::pair<StampNs, StampNs>>;
using Matcher = StampMatcher<StampNs, StampNs>;

constexpr StampNs kMs = 1'000'000;
constexpr StampNs kStart = 1'305'031'102'000 * kMs;

void Append(Pairs& all, const Pairs& more) { all.insert(all.end(), more.begin(), more.end()); }

/// Stamps of a 30 Hz stream with jitter and gaps.
Stamps RandomStream(std::mt19937& random, StampNs offset_ns) {
  std::uniform_int_distribution<StampNs> jitter_us(-9000, 9000);
  std::bernoulli_distribution lost(0.1);
  Stamps stamps;
  for (int i = 0; i < 60; ++i) {
    if (!lost(random)) {
      stamps.push_back(kStart + offset_ns + i * 33 * kMs + jitter_us(random) * 1000);
    }
  }
  return stamps;
}

/// Feeds both streams, each in order, interleaved by stamp plus a delay of the second.
Pairs Match(const Stamps& first, const Stamps& second, StampNs second_delay_ns) {
  Matcher matcher({});
  Pairs pairs;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < first.size() || j < second.size()) {
    const bool take_first =
        j == second.size() || (i < first.size() && first[i] < second[j] + second_delay_ns);
    if (take_first) {
      Append(pairs, matcher.AddFirst(first[i], first[i]));
      ++i;
    } else {
      Append(pairs, matcher.AddSecond(second[j], second[j]));
      ++j;
    }
  }
  Append(pairs, matcher.Flush());
  return pairs;
}

Pairs Associate(const Stamps& first, const Stamps& second) {
  Pairs pairs;
  for (const auto& match : AssociateStamps(first, second, StampMatcherOptions().max_difference_s)) {
    pairs.emplace_back(first[match.first], second[match.second]);
  }
  return pairs;
}

TEST(StampMatcher, EqualsAssociationOfCompleteListsForAnyInterleaving) {
  std::mt19937 random(7);
  for (const StampNs offset_ms : {-16, -15, 0, 3, 17}) {
    const Stamps first = RandomStream(random, 0);
    const Stamps second = RandomStream(random, offset_ms * kMs);
    const Pairs expected = Associate(first, second);
    EXPECT_GT(expected.size(), 30U);
    for (const StampNs delay_ms : {-200, -40, 0, 5, 60, 300}) {
      EXPECT_EQ(Match(first, second, delay_ms * kMs), expected) << offset_ms << " " << delay_ms;
    }
  }
}

TEST(StampMatcher, GivesTheSamePairsWhenOnlyPairsAreFedAgain) {
  std::mt19937 random(8);
  const Pairs pairs = Match(RandomStream(random, 0), RandomStream(random, -15 * kMs), 0);
  Stamps first;
  Stamps second;
  for (const auto& [a, b] : pairs) {
    first.push_back(a);
    second.push_back(b);
  }
  EXPECT_EQ(Match(first, second, 0), pairs);
}

TEST(StampMatcher, DecidesEqualStampsAtOnce) {
  Matcher matcher({});
  EXPECT_TRUE(matcher.AddFirst(kStart, 1).empty());
  EXPECT_EQ(matcher.AddSecond(kStart, 2), (Pairs{{1, 2}}));
}

TEST(StampMatcher, WaitsForACloserPartnerUnlessEager) {
  StampMatcherOptions options;
  Matcher patient(options);
  EXPECT_TRUE(patient.AddSecond(kStart, 1).empty());
  EXPECT_TRUE(patient.AddFirst(kStart + 15 * kMs, 2).empty());
  EXPECT_EQ(patient.AddSecond(kStart + 20 * kMs, 3), Pairs{});
  EXPECT_EQ(patient.AddFirst(kStart + 48 * kMs, 4), (Pairs{{2, 3}}));

  options.eager = true;
  Matcher eager(options);
  EXPECT_TRUE(eager.AddSecond(kStart, 1).empty());
  EXPECT_EQ(eager.AddFirst(kStart + 15 * kMs, 2), (Pairs{{2, 1}}));
}

TEST(StampMatcher, IgnoresRepeatsAndStartsAnewWhenTimeIsTurnedBack) {
  Matcher matcher({});
  matcher.AddFirst(kStart, 1);
  EXPECT_TRUE(matcher.AddFirst(kStart, 2).empty());
  matcher.AddFirst(kStart - 5000 * kMs, 3);
  EXPECT_EQ(matcher.AddSecond(kStart - 5000 * kMs, 4), (Pairs{{3, 4}}));
  EXPECT_TRUE(matcher.AddSecond(kStart, 5).empty()) << "1 has been forgotten";
}

TEST(StampMatcher, KeepsAtMostItsCapacityAndTellsTheClosestMiss) {
  StampMatcherOptions options;
  options.capacity = 3;
  Matcher matcher(options);
  EXPECT_FALSE(matcher.ClosestMissS());
  for (int i = 0; i < 10; ++i) matcher.AddFirst(kStart + i * 33 * kMs, i);
  matcher.AddSecond(kStart + 7 * 33 * kMs + 25 * kMs, 0);
  EXPECT_FALSE(matcher.AddSecond(kStart + 9 * 33 * kMs, 0).empty());
  EXPECT_FALSE(matcher.ClosestMissS() && *matcher.ClosestMissS() < options.max_difference_s);
}

}  // namespace
}  // namespace posefusion
