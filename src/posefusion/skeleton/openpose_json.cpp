#include "posefusion/skeleton/openpose_json.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "posefusion/skeleton/skeleton_checks.h"
#include "posefusion/skeleton/skeleton_layout.h"

namespace posefusion {
namespace {

using Json = nlohmann::json;

constexpr int kMaxDepth = 32;  ///< of brackets; OpenPose's own are 4 deep
constexpr std::size_t kNumbersPerJoint = 3;

[[noreturn]] void Refuse(const std::string& source, const std::string& why) {
  throw std::runtime_error(source + ": " + why);
}

Json Parse(const std::string& text, const std::string& source) {
  if (text.size() > kMaxOpenPoseBytes) {
    Refuse(source, "has " + std::to_string(text.size()) + " bytes, more than " +
                       std::to_string(kMaxOpenPoseBytes));
  }
  const auto check_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kMaxDepth) Refuse(source, "brackets are nested too deeply");
    return true;
  };
  try {
    return Json::parse(text, check_depth);
  } catch (const Json::parse_error& error) {
    Refuse(source, "malformed JSON at byte " + std::to_string(error.byte));
  } catch (const Json::exception&) {
    Refuse(source, "malformed JSON: a number that is too large");
  }
}

/// The list of numbers of a person. @throws when there is none.
const Json& NumbersOf(const Json& person, const std::string& source) {
  if (person.is_object()) {
    for (const char* key : {"pose_keypoints_2d", "pose_keypoints"}) {
      const auto numbers = person.find(key);
      if (numbers != person.end() && numbers->is_array()) return *numbers;
    }
  }
  Refuse(source, "a person without the list pose_keypoints_2d");
}

SkeletonLayout LayoutOf(const Json& numbers, const std::string& source) {
  const bool whole = numbers.size() % kNumbersPerJoint == 0;
  const auto layout = whole ? LayoutWithJoints(numbers.size() / kNumbersPerJoint) : std::nullopt;
  if (layout) return *layout;
  Refuse(source, "pose_keypoints_2d has " + std::to_string(numbers.size()) +
                     " numbers, not 54 (COCO-18) or 75 (BODY_25)");
}

double NumberAt(const Json& numbers, std::size_t i, const std::string& source) {
  if (numbers[i].is_number()) return numbers[i].get<double>();
  Refuse(source, "pose_keypoints_2d holds something else than numbers: entry " + std::to_string(i) +
                     " is of type " + numbers[i].type_name());
}

Skeleton ReadPerson(const Json& numbers, SkeletonLayout layout, const std::string& source) {
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < numbers.size(); i += kNumbersPerJoint) {
    joints.push_back(UsableJoint(NumberAt(numbers, i, source), NumberAt(numbers, i + 1, source),
                                 NumberAt(numbers, i + 2, source)));
  }
  return ToCocoOrder(layout, joints);
}

}  // namespace

std::string ToOpenPoseJson(const std::vector<Skeleton>& people) {
  std::string text = "{\"version\":1.3,\"people\":[";
  for (std::size_t i = 0; i < people.size(); ++i) {
    text += i > 0 ? ",{" : "{";
    text += "\"person_id\":[-1],\"pose_keypoints_2d\":[";
    for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
      const Joint& joint = people[i][j];
      std::array<char, 64> numbers{};
      std::snprintf(numbers.data(), numbers.size(), "%s%.3f,%.3f,%.4f", j > 0 ? "," : "",
                    static_cast<double>(joint.u), static_cast<double>(joint.v),
                    static_cast<double>(joint.p));
      text += numbers.data();
    }
    text += "]}";
  }
  return text + "]}\n";
}

OpenPosePeople ReadOpenPoseJson(const std::string& text, const std::string& source) {
  const Json json = Parse(text, source);
  if (!json.is_object() || !json.contains("people") || !json["people"].is_array()) {
    Refuse(source, "has no list 'people'");
  }
  OpenPosePeople result;
  std::optional<SkeletonLayout> layout;
  for (const Json& person : json["people"]) {
    const Json& numbers = NumbersOf(person, source);
    const SkeletonLayout own = LayoutOf(numbers, source);
    if (layout && own != *layout) Refuse(source, "people of two layouts, COCO-18 and BODY_25");
    layout = own;
    result.people.push_back(ReadPerson(numbers, own, source));
  }
  if (layout) result.layout = *layout;
  result.num_left_out = KeepMostCertain(result.people);
  return result;
}

}  // namespace posefusion
