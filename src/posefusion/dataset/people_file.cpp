#include "posefusion/dataset/people_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"

namespace posefusion {
namespace {

constexpr char kComment[] = "# stamp person part x0 y0 z0 x1 y1 z1 radius\n";
constexpr std::size_t kNumNumbers = 9;  ///< behind the stamp
constexpr char kBlanks[] = " \t\r";

std::string FormatCapsule(const std::string& stamp, const PersonCapsule& capsule) {
  const Eigen::Vector3d a = capsule.begin_m.cast<double>();
  const Eigen::Vector3d b = capsule.end_m.cast<double>();
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), "%s %d %d %.4f %.4f %.4f %.4f %.4f %.4f %.4f\n",
                stamp.c_str(), capsule.person, capsule.part, a.x(), a.y(), a.z(), b.x(), b.y(),
                b.z(), static_cast<double>(capsule.radius_m));
  return text.data();
}

/// The numbers of a line's rest; nothing when there are others than the expected ones. A long run
/// has millions of lines, which is why they are not taken apart into strings first.
std::optional<std::array<double, kNumNumbers>> ParseNumbers(const char* text) {
  std::array<double, kNumNumbers> numbers{};
  for (double& number : numbers) {
    char* end = nullptr;
    number = std::strtod(text, &end);
    if (end == text || !std::isfinite(number)) return std::nullopt;
    text = end;
  }
  const std::string rest = text;
  if (rest.find_first_not_of(kBlanks) != std::string::npos) return std::nullopt;
  return numbers;
}

PersonCapsule MakeCapsule(const std::array<double, kNumNumbers>& n) {
  PersonCapsule capsule;
  capsule.person = static_cast<int>(n[0]);
  capsule.part = static_cast<int>(n[1]);
  capsule.begin_m = Eigen::Vector3d(n[2], n[3], n[4]).cast<float>();
  capsule.end_m = Eigen::Vector3d(n[5], n[6], n[7]).cast<float>();
  capsule.radius_m = static_cast<float>(n[8]);
  return capsule;
}

void ParseLine(const std::string& line, const std::string& name,
               std::vector<PeopleAtStamp>& people) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string::npos || line[begin] == '#') return;
  const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
  const auto stamp_ns = ParseStamp(line.substr(begin, end - begin));
  const auto numbers = ParseNumbers(line.c_str() + end);
  if (!stamp_ns || !numbers) {
    throw std::runtime_error(name + ": expected 'stamp person part x0 y0 z0 x1 y1 z1 radius'");
  }
  if (people.empty() || people.back().stamp_ns != *stamp_ns) people.push_back({*stamp_ns, {}});
  people.back().capsules.push_back(MakeCapsule(*numbers));
}

}  // namespace

void WritePeople(const std::vector<PeopleAtStamp>& people, const std::string& path) {
  std::string text = kComment;
  for (const PeopleAtStamp& moment : people) {
    const std::string stamp = FormatStamp(moment.stamp_ns);
    for (const PersonCapsule& capsule : moment.capsules) text += FormatCapsule(stamp, capsule);
  }
  WriteFileAtomically(path, text);
}

std::vector<PeopleAtStamp> ReadPeople(const std::string& path) {
  const std::string text = ReadWholeFile(path);
  std::vector<PeopleAtStamp> people;
  std::size_t begin = 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    ParseLine(text.substr(begin, end - begin), path + ":" + std::to_string(number), people);
    begin = end + 1;
  }
  std::stable_sort(people.begin(), people.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  return people;
}

}  // namespace posefusion
