#include "posefusion/simulation/keypoints.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "posefusion/skeleton/openpose_json.h"

namespace posefusion {
namespace {

const CameraModel kCamera{640, 480, 525, 525, 319.5, 239.5, {}};
constexpr double kInterval = 1.0 / 30;
constexpr int kNumFrames = 6000;

/// A person of 300 px in the middle of the image with every joint in sight.
TruePerson VisiblePerson() {
  TruePerson person;
  for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
    person.joints[i] = {300 + 5.0 * static_cast<double>(i % 4),
                        90 + 300.0 * static_cast<double>(i) / 17, 2.5, true};
  }
  return person;
}

struct Tally {
  int people = 0;
  int joints = 0;
  double squares = 0;  ///< of the distances of joints closer than 20 px
  int near = 0;
};

Tally Count(const std::vector<TruePerson>& truth, const KeypointFaultConfig& config) {
  Tally tally;
  for (int i = 0; i < kNumFrames; ++i) {
    for (const Skeleton& found : DetectPeople(truth, config, kCamera, i * kInterval, 1)) {
      ++tally.people;
      for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
        if (found[j].p <= 0) continue;
        ++tally.joints;
        if (truth.empty()) continue;
        const TrueJoint& joint = truth[0].joints[j];
        const double distance = std::hypot(found[j].u - joint.u, found[j].v - joint.v);
        if (distance > 20) continue;
        ++tally.near;
        tally.squares += distance * distance;
      }
    }
  }
  return tally;
}

TEST(DetectPeople, MissesPeopleAndJointsAsOftenAsConfigured) {
  KeypointFaultConfig config;
  config.false_person_hz = 0;
  const Tally tally = Count({VisiblePerson()}, config);
  EXPECT_NEAR(tally.people, kNumFrames * (1 - config.missed_person), 0.02 * kNumFrames);
  const double per_person = static_cast<double>(tally.joints) / tally.people;
  EXPECT_NEAR(per_person, kNumCocoJoints * (1 - config.missed_joint), 0.3);
}

TEST(DetectPeople, MisplacesJointsByAShareOfTheHeight) {
  KeypointFaultConfig config;
  config.false_person_hz = config.outlier = 0;
  const Tally tally = Count({VisiblePerson()}, config);
  const double deviation = std::sqrt(tally.squares / (2 * tally.near));  // of u and of v
  EXPECT_NEAR(deviation, config.noise_share * 300, 0.2);
}

TEST(DetectPeople, SeesPeopleWhereNobodyIs) {
  KeypointFaultConfig config;
  config.false_person_hz = 0.3;
  const Tally tally = Count({}, config);
  EXPECT_NEAR(tally.people, 0.3 * config.fault_seconds * kNumFrames, 0.03 * kNumFrames);
  EXPECT_GT(tally.joints, 5 * tally.people);
}

TEST(DetectPeople, FaultsLastForSeveralFrames) {
  KeypointFaultConfig config;
  config.missed_person = 0.2;
  config.false_person_hz = 0;
  int num_missed = 0;
  int num_changes = 0;
  bool before = false;
  for (int i = 0; i < kNumFrames; ++i) {
    const bool missed = DetectPeople({VisiblePerson()}, config, kCamera, i * kInterval, 1).empty();
    num_missed += missed ? 1 : 0;
    num_changes += missed != before ? 1 : 0;
    before = missed;
  }
  EXPECT_GT(2.0 * num_missed / num_changes, 8);  // frames per gap
}

TEST(DetectPeople, DependsOnTimeAndSeedAlone) {
  const std::vector<TruePerson> truth = {VisiblePerson()};
  const auto text = [&](double time_s, int seed) {
    return ToOpenPoseJson(DetectPeople(truth, {}, kCamera, time_s, seed));
  };
  EXPECT_EQ(text(3.3, 1), text(3.3, 1));
  EXPECT_NE(text(3.3, 1), text(3.4, 1));
  EXPECT_NE(text(3.3, 1), text(3.3, 2));
}

TEST(DetectPeople, HiddenJointsAreSeldomFoundAndUncertain) {
  TruePerson person = VisiblePerson();
  for (TrueJoint& joint : person.joints) joint.visible = &joint < &person.joints[9];
  KeypointFaultConfig config;
  config.false_person_hz = config.missed_person = config.outlier = 0;
  int num_hidden_found = 0;
  for (int i = 0; i < kNumFrames; ++i) {
    const auto people = DetectPeople({person}, config, kCamera, i * kInterval, 1);
    for (std::size_t j = 9; j < kNumCocoJoints; ++j) {
      if (people.at(0)[j].p <= 0) continue;
      ++num_hidden_found;
      ASSERT_LT(people[0][j].p, 0.45);
    }
  }
  EXPECT_NEAR(num_hidden_found, 9 * kNumFrames * config.hidden_found, 0.03 * 9 * kNumFrames);
}

TEST(ToOpenPoseJson, IsReadAsJsonWithThreeNumbersPerJoint) {
  const auto json = nlohmann::json::parse(ToOpenPoseJson(PerfectKeypoints({VisiblePerson()})));
  EXPECT_EQ(json["version"], 1.3);
  const auto& numbers = json["people"].at(0)["pose_keypoints_2d"];
  ASSERT_EQ(numbers.size(), 54u);
  EXPECT_DOUBLE_EQ(numbers[3], 305);
  EXPECT_DOUBLE_EQ(numbers[5], 1);
  EXPECT_TRUE(nlohmann::json::parse(ToOpenPoseJson({}))["people"].empty());
}

TEST(KeypointArrival, KeepsRateAndDelay) {
  KeypointTiming timing;
  timing.rate_hz = 5;
  timing.latency_s = 0.3;
  int num_arrivals = 0;
  for (int i = 0; i < 300; ++i) {
    const double time_s = std::round(i * kInterval * 1e6) * 1e-6;
    const auto arrival = KeypointArrival(timing, time_s, kInterval, 1);
    if (!arrival) continue;
    ++num_arrivals;
    EXPECT_NEAR(*arrival - time_s, 0.3, 0.3 * timing.latency_jitter + 1e-9);
  }
  EXPECT_EQ(num_arrivals, 50);
}

TEST(KeypointArrival, IsOnTimeAtEveryFrameByDefault) {
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(KeypointArrival({}, i * kInterval, kInterval, 1), i * kInterval);
}

}  // namespace
}  // namespace posefusion
