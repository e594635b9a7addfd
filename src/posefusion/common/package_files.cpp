#include "posefusion/common/package_files.h"

#include <filesystem>

namespace posefusion {

std::string FindPackageFile(const std::string& relative_path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path() / "../../share/posefusion";
  for (const fs::path& root : {installed, fs::path(POSEFUSION_SOURCE_DIR)}) {
    const fs::path candidate = root / relative_path;
    if (fs::exists(candidate, error)) return candidate.lexically_normal().string();
  }
  return "";
}

}  // namespace posefusion
