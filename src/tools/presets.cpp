#include "presets.h"

#include <algorithm>
#include <filesystem>

#include "posefusion/common/package_files.h"

namespace posefusion {
namespace {

constexpr char kFolder[] = "config/presets";
constexpr char kEnding[] = ".yaml";

}  // namespace

std::vector<std::string> PresetNames() {
  std::vector<std::string> names;
  const std::string folder = FindPackageFile(kFolder);
  if (folder.empty()) return names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == kEnding) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string PresetFile(const std::string& name) {
  return FindPackageFile(std::string(kFolder) + "/" + name + kEnding);
}

}  // namespace posefusion
