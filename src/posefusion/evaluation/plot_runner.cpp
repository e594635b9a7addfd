#include "posefusion/evaluation/plot_runner.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace posefusion {
namespace {

/// Debian's own, which has the matplotlib package; another python may come first in PATH.
constexpr char kPython[] = "/usr/bin/python3";
constexpr char kScriptName[] = "plot_trajectory.py";

/// The script beside an installed program, else in the source tree; empty when in neither.
std::string FindScript() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const auto& folder : {program.parent_path() / "../../share/posefusion/scripts",
                             std::filesystem::path(POSEFUSION_SOURCE_SCRIPTS)}) {
    const auto script = folder / kScriptName;
    if (std::filesystem::exists(script, error)) return script;
  }
  return "";
}

}  // namespace

std::string PlotEvaluation(const std::string& folder) {
  std::string script = FindScript();
  if (script.empty()) return std::string(kScriptName) + " is not installed";
  std::string python = kPython;
  std::string argument = folder;
  std::array<char*, 4> arguments = {python.data(), script.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawn(&child, kPython, nullptr, nullptr, arguments.data(), environ);
  if (error != 0) return python + " cannot be run: " + std::strerror(error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return python + " was lost: " + std::strerror(errno);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return script + " failed";
}

}  // namespace posefusion
