// Whatever bytes a file of keypoints holds, reading it gives valid people or one clear error.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "posefusion/skeleton/openpose_json.h"
#include "test/skeleton/sample_skeletons.h"

namespace posefusion {
namespace {

constexpr int kNumMutants = 20'000;

/// True when the text was read; every other way out than the promised ones fails the test.
bool ReadsOrRefuses(const std::string& text) {
  try {
    const OpenPosePeople read = ReadOpenPoseJson(text, "fuzz");
    EXPECT_LE(read.people.size(), 15U);
    for (const float number : testing::Numbers(read.people)) EXPECT_TRUE(std::isfinite(number));
    for (const Skeleton& person : read.people) {
      for (const Joint& joint : person) EXPECT_TRUE(joint.p >= 0 && joint.p <= 1);
    }
    return true;
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("fuzz: ", 0), 0U) << message;
    EXPECT_LT(message.size(), 200U);
    return false;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another exception: " << error.what();
  }
  return false;
}

/// One of the changes that files suffer.
void Mutate(std::string& text, std::mt19937& random) {
  static const std::vector<std::string> kPieces = {
      "1e999", "-1e999", "NaN",  "null", "[",           "]",      "{",
      "}",     ",",      "\"",   "-",    "1e-400",      "[[[[[[", "18446744073709551616",
      "true",  "\\u00",  "\xff", ":",    "\"people\":", "0x1",    "pose_keypoints_2d"};
  const auto below = [&](std::size_t end) { return random() % end; };
  if (text.empty()) text = "x";
  const std::size_t place = below(text.size());
  const std::size_t digit = text.find_first_of("0123456789", place);
  switch (below(6)) {
    case 0:
      text[place] = static_cast<char>(below(256));
      break;
    case 1:
      text.erase(place, 1 + below(40));
      break;
    case 2:
      text.insert(place, kPieces[below(kPieces.size())]);
      break;
    case 3:
      text.insert(place, text.substr(below(text.size()), below(200)));
      break;
    case 4:
      if (digit != std::string::npos) text[digit] = "0123456789e-"[below(12)];
      break;
    default:
      text.resize(place);
  }
}

TEST(OpenPoseJsonFuzz, MutantsOfGoodTextsAreReadOrRefused) {
  std::mt19937 random(42);
  const std::string good = ToOpenPoseJson({testing::PersonAt(3, 4), testing::PersonAt(300, 200)});
  int num_read = 0;
  for (int i = 0; i < kNumMutants && !::testing::Test::HasFailure(); ++i) {
    std::string text = good;
    const auto num_changes = 1 + random() % 3;
    for (std::size_t change = 0; change < num_changes; ++change) Mutate(text, random);
    num_read += ReadsOrRefuses(text) ? 1 : 0;
  }
  EXPECT_GT(num_read, kNumMutants / 50) << "the fuzzing must reach behind the parser";
  EXPECT_LT(num_read, kNumMutants);
}

RC_GTEST_PROP(OpenPoseJsonFuzz, AnyBytesAreReadOrRefused, (const std::string& text)) {
  ReadsOrRefuses(text);
}

RC_GTEST_PROP(OpenPoseJsonFuzz, AnyNumbersAreReadOrRefused, (const std::vector<double>& numbers)) {
  std::string list;
  for (std::size_t i = 0; i < 54; ++i) {
    const double number = numbers.empty() ? 0 : numbers[i % numbers.size()];
    list += (i > 0 ? "," : "") + std::to_string(number);
  }
  ReadsOrRefuses("{\"people\":[{\"pose_keypoints_2d\":[" + list + "]}]}");
}

TEST(OpenPoseJsonFuzz, HugeListsAreReadOrRefused) {
  std::string numbers = "{\"people\":[{\"pose_keypoints_2d\":[0";
  while (numbers.size() + 10 < kMaxOpenPoseBytes) numbers += ",0";
  EXPECT_FALSE(ReadsOrRefuses(numbers + "]}]}"));
  std::string people = "{\"people\":[" + std::string(kMaxOpenPoseBytes - 100, ' ') + "{}]}";
  EXPECT_FALSE(ReadsOrRefuses(people));
  std::string empty_lists = "{\"people\":[],\"x\":[[]";
  while (empty_lists.size() + 10 < kMaxOpenPoseBytes) empty_lists += ",[]";
  EXPECT_TRUE(ReadsOrRefuses(empty_lists + "]}"));
}

}  // namespace
}  // namespace posefusion
