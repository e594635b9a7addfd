#include "posefusion/skeleton/keypoint_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

#include "posefusion/common/text_lines.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

constexpr const char* kArrivalFile = "arrival.txt";
constexpr const char* kSuffix = "_keypoints";
constexpr std::size_t kNumDigits = 12;

std::vector<fs::path> SortedJsonFiles(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  }
  if (error) {
    throw std::invalid_argument(folder + ": no folder of keypoints: " + error.message());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// The number in `<name>_000000000012`; empty for other names.
std::optional<std::int64_t> NumberIn(const std::string& name) {
  const std::size_t underscore = name.rfind('_');
  const std::string digits = underscore == std::string::npos ? name : name.substr(underscore + 1);
  const bool all_digits = digits.find_first_not_of("0123456789") == std::string::npos;
  if (digits.size() != kNumDigits || !all_digits) return std::nullopt;
  return std::stoll(digits);
}

struct FileName {
  bool numbered = false;
  std::int64_t key = 0;
};

std::optional<FileName> ReadName(const fs::path& path) {
  std::string name = path.stem();
  const std::size_t suffix = name.rfind(kSuffix);
  const std::size_t suffix_length = std::string(kSuffix).size();
  if (suffix != std::string::npos && suffix + suffix_length == name.size()) {
    name.erase(suffix);
    if (const auto number = NumberIn(name)) return FileName{true, *number};
  }
  if (const auto stamp_ns = ParseStamp(name)) return FileName{false, *stamp_ns};
  return std::nullopt;
}

std::map<StampNs, StampNs> ReadArrivals(const std::string& path) {
  std::map<StampNs, StampNs> arrivals;
  for (const TextLine& line : ReadTextLines(path)) {
    const bool two = line.columns.size() == 2;
    const auto stamp_ns = ParseStamp(line.columns.front());
    const auto arrival_ns = two ? ParseStamp(line.columns.back()) : std::nullopt;
    if (!stamp_ns || !arrival_ns || *arrival_ns < *stamp_ns) {
      throw std::invalid_argument(LineName(path, line) +
                                  ": expected 'stamp arrival_stamp', the second not earlier");
    }
    arrivals[*stamp_ns] = *arrival_ns;
  }
  return arrivals;
}

}  // namespace

KeypointFiles ListKeypointFiles(const std::string& folder) {
  KeypointFiles files;
  for (const fs::path& path : SortedJsonFiles(folder)) {
    const auto name = ReadName(path);
    if (!name) {
      ++files.num_unknown;
      continue;
    }
    if (!files.paths.empty() && name->numbered != files.numbered) {
      throw std::invalid_argument(folder + ": files named by stamp and numbered ones: " +
                                  files.paths.begin()->second + ", " + path.string());
    }
    files.numbered = name->numbered;
    files.paths.emplace(name->key, path);
  }
  const fs::path arrival_file = fs::path(folder) / kArrivalFile;
  if (fs::exists(arrival_file)) files.arrival_ns = ReadArrivals(arrival_file);
  return files;
}

}  // namespace posefusion
