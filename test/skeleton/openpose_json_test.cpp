#include "posefusion/skeleton/openpose_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "test/skeleton/sample_skeletons.h"

namespace posefusion {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Numbers;
using testing::PersonAt;
using ::testing::ThrowsMessage;

/// A text with one person of these many numbers, 0 1 2 3 ...; the confidences (every third) are .5.
std::string TextWithNumbers(int count) {
  std::string numbers;
  for (int i = 0; i < count; ++i) {
    numbers += (i > 0 ? "," : "") + (i % 3 == 2 ? std::string("0.5") : std::to_string(i));
  }
  return R"({"people":[{"pose_keypoints_2d":[)" + numbers + "]}]}";
}

std::string TextWithFirstJoint(const std::string& numbers) {
  std::string text = R"({"people":[{"pose_keypoints_2d":[)" + numbers;
  for (int i = 3; i < 54; ++i) text += ",0";
  return text + "]}]}";
}

void ExpectRefused(const std::string& text, const std::string& why) {
  EXPECT_THAT(
      [&] { ReadOpenPoseJson(text, "folder/1.5.json"); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("folder/1.5.json: "), HasSubstr(why))))
      << text.substr(0, 100);
}

TEST(OpenPoseJson, ReadsWhatItWrites) {
  const std::vector<Skeleton> people = {PersonAt(10, 20, 0.25F), PersonAt(100.5F, 7.125F, 1)};
  const OpenPosePeople read = ReadOpenPoseJson(ToOpenPoseJson(people), "text");
  EXPECT_EQ(Numbers(read.people), Numbers(people));
  EXPECT_EQ(read.layout, SkeletonLayout::kCoco18);
  EXPECT_EQ(read.num_left_out, 0);
}

TEST(OpenPoseJson, NobodySeenIsNoError) {
  EXPECT_TRUE(ReadOpenPoseJson(R"({"version":1.3,"people":[]})", "text").people.empty());
}

TEST(OpenPoseJson, Body25IsMappedByTheNamesOfJoints) {
  const OpenPosePeople read = ReadOpenPoseJson(TextWithNumbers(75), "text");
  EXPECT_EQ(read.layout, SkeletonLayout::kBody25);
  ASSERT_EQ(read.people.size(), 1U);
  const Skeleton& person = read.people[0];
  const auto number_of = [&](CocoJoint joint) { return person[joint].u / 3; };
  EXPECT_EQ(number_of(kNose), 0);
  EXPECT_EQ(number_of(kNeck), 1);
  EXPECT_EQ(number_of(kLeftWrist), 7);
  EXPECT_EQ(number_of(kRightHip), 9) << "8 is the middle of the hip";
  EXPECT_EQ(number_of(kRightAnkle), 11);
  EXPECT_EQ(number_of(kLeftHip), 12);
  EXPECT_EQ(number_of(kLeftAnkle), 14);
  EXPECT_EQ(number_of(kRightEye), 15);
  EXPECT_EQ(number_of(kLeftEye), 16);
  EXPECT_EQ(number_of(kRightEar), 17);
  EXPECT_EQ(number_of(kLeftEar), 18);
}

TEST(OpenPoseJson, OtherNumbersOfNumbersAreToldAsTheyAre) {
  ExpectRefused(TextWithNumbers(51), "has 51 numbers");
  ExpectRefused(TextWithNumbers(63), "has 63 numbers");
  ExpectRefused(TextWithNumbers(55), "has 55 numbers");
  ExpectRefused(TextWithNumbers(0), "has 0 numbers");
}

TEST(OpenPoseJson, MalformedTextsAreRefused) {
  ExpectRefused("", "malformed JSON");
  ExpectRefused("{\"people\":[", "malformed JSON at byte");
  ExpectRefused("nonsense", "malformed JSON at byte 2");
  ExpectRefused("[]", "has no list 'people'");
  ExpectRefused("{}", "has no list 'people'");
  ExpectRefused("{\"people\":3}", "has no list 'people'");
  ExpectRefused("{\"people\":[1]}", "a person without the list");
  ExpectRefused("{\"people\":[{\"pose_keypoints_2d\":\"1,2\"}]}", "a person without the list");
  ExpectRefused(TextWithFirstJoint("\"1\",2,0.5"), "entry 0 is of type string");
  ExpectRefused(TextWithFirstJoint("1,null,0.5"), "entry 1 is of type null");
  ExpectRefused(TextWithFirstJoint("1,2,[0.5]"), "entry 2 is of type array");
  ExpectRefused(TextWithFirstJoint("NaN,2,0.5"), "malformed JSON");
  ExpectRefused(TextWithFirstJoint("1e999,2,0.5"), "too large");
}

TEST(OpenPoseJson, HugeAndDeepTextsAreRefused) {
  ExpectRefused(std::string(kMaxOpenPoseBytes + 1, ' '), "1048577 bytes");
  ExpectRefused(std::string(500'000, '['), "nested too deeply");
  std::string deep = "{\"people\":[],\"more\":";
  for (int i = 0; i < 100'000; ++i) deep += "{\"a\":";
  ExpectRefused(deep, "nested too deeply");
}

TEST(OpenPoseJson, PeopleOfTwoLayoutsAreRefused) {
  const std::string coco = TextWithNumbers(54);
  const std::string body25 = TextWithNumbers(75);
  const auto person = [](const std::string& text) { return text.substr(11, text.size() - 13); };
  ExpectRefused("{\"people\":[" + person(coco) + "," + person(body25) + "]}", "two layouts");
}

TEST(OpenPoseJson, JointsThatMakeNoSenseAreNotFound) {
  for (const char* numbers : {"5,5,-0.5", "1e300,5,0.5", "5,-1e30,0.5", "5,5,0"}) {
    const OpenPosePeople read = ReadOpenPoseJson(TextWithFirstJoint(numbers), "text");
    EXPECT_EQ(read.people.at(0)[0].p, 0) << numbers;
    EXPECT_EQ(read.people.at(0)[0].u, 0) << numbers;
  }
  EXPECT_EQ(ReadOpenPoseJson(TextWithFirstJoint("5,5,1.2"), "text").people.at(0)[0].p, 1);
}

TEST(OpenPoseJson, KeepsTheFifteenMostCertainPeople) {
  std::vector<Skeleton> people;
  for (int i = 0; i < 18; ++i) people.push_back(PersonAt(static_cast<float>(i), 0, 0.5F));
  for (const int unsure : {2, 9, 17}) {
    people[static_cast<std::size_t>(unsure)] = PersonAt(static_cast<float>(unsure), 0, 0.25F);
  }
  const OpenPosePeople read = ReadOpenPoseJson(ToOpenPoseJson(people), "text");
  EXPECT_EQ(read.num_left_out, 3);
  ASSERT_EQ(read.people.size(), 15U);
  EXPECT_EQ(read.people[2][0].u, 3);
  EXPECT_EQ(read.people[8][0].u, 10);
  EXPECT_EQ(read.people[14][0].u, 16);
}

}  // namespace
}  // namespace posefusion
