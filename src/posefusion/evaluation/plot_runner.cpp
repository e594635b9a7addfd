#include "posefusion/evaluation/plot_runner.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "posefusion/common/package_files.h"

namespace posefusion {
namespace {

/// Debian's own, which has the matplotlib package; another python may come first in PATH.
constexpr char kPython[] = "/usr/bin/python3";
constexpr char kScript[] = "scripts/plot_trajectory.py";

}  // namespace

std::string PlotEvaluation(const std::string& folder) {
  std::string script = FindPackageFile(kScript);
  if (script.empty()) return std::string(kScript) + " is not installed";
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
