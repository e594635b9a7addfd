#include "posefusion/common/confined_path.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace posefusion {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const std::string& name, const std::string& why) {
  throw std::invalid_argument("file name '" + name + "' " + why);
}

/// `path` lies below `folder`; both without links and dots.
bool IsBelow(const fs::path& path, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() && rest != path.end();
}

void CheckName(const std::string& name) {
  if (name.empty()) Refuse(name, "is empty");
  if (name.find('\0') != std::string::npos) Refuse(name.c_str(), "holds a zero byte");
  const fs::path path(name);
  if (path.is_absolute()) Refuse(name, "is absolute; it must be relative to the output folder");
  const auto is = [](const char* text) {
    return [text](const fs::path& part) { return part == text; };
  };
  if (std::any_of(path.begin(), path.end(), is(".."))) Refuse(name, "holds '..'");
  if (!path.has_filename() || path.filename() == ".") Refuse(name, "names a folder");
}

}  // namespace

std::string ConfinedPath(const std::string& folder, const std::string& name, bool overwrite) {
  CheckName(name);
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) throw std::invalid_argument("output folder '" + folder + "': " + error.message());
  const fs::path given = root / name;
  const fs::path parent = fs::canonical(given.parent_path(), error);
  if (error) Refuse(name, "is in a folder that cannot be used: " + error.message());
  const fs::path path = parent / given.filename();
  if (!IsBelow(path, root)) Refuse(name, "leads out of the output folder");
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return path.string();
  if (fs::is_symlink(status)) Refuse(name, "is a link");
  if (!fs::is_regular_file(status)) Refuse(name, "is not a file");
  if (!overwrite) Refuse(name, "exists; ask for overwriting");
  return path.string();
}

}  // namespace posefusion
