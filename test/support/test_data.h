#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace posefusion {

/// Folder or file of recorded data that is not part of the repository, below POSEFUSION_DATA.
inline std::string DataPath(const std::string& name) {
  const char* root = std::getenv("POSEFUSION_DATA");
  return std::string(root != nullptr ? root : POSEFUSION_DEFAULT_DATA) + "/" + name;
}

}  // namespace posefusion

/// Ends a test that needs recorded data as skipped where there is none.
#define SKIP_WITHOUT_DATA(name)                             \
  if (!std::filesystem::exists(posefusion::DataPath(name))) \
  GTEST_SKIP() << posefusion::DataPath(name) << " is absent (see POSEFUSION_DATA)"
