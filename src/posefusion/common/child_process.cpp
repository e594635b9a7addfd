#include "posefusion/common/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>

namespace posefusion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPollPeriod(20);  ///< next to nothing of a run of seconds

/// The files and the process group that a child starts with.
class SpawnSettings {
 public:
  explicit SpawnSettings(const std::string& log_path) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, log_path.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(&files_, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  pid_t Spawn(const std::vector<std::string>& command) const {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int error =
        posix_spawn(&child, arguments.front(), &files_, &attributes_, arguments.data(), environ);
    if (error == 0) return child;
    throw std::runtime_error(command.front() + ": cannot be run: " + std::strerror(error));
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

ChildExit ExitOf(int status, bool stopped) {
  ChildExit result;
  result.stopped = stopped;
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

}  // namespace

ChildExit RunChild(const std::vector<std::string>& command, const std::string& log_path,
                   const std::function<bool()>& should_stop, double grace_s) {
  const SpawnSettings settings(log_path);
  const pid_t child = settings.Spawn(command);
  std::optional<Clock::time_point> stopped_at;
  while (true) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return ExitOf(status, stopped_at.has_value());
    if (ended < 0 && errno != EINTR) {
      throw std::runtime_error(command.front() + ": was lost: " + std::strerror(errno));
    }
    if (!stopped_at && should_stop()) {
      stopped_at = Clock::now();
      kill(-child, SIGTERM);
    }
    const std::chrono::duration<double> waited = Clock::now() - stopped_at.value_or(Clock::now());
    if (waited.count() > grace_s) kill(-child, SIGKILL);
    std::this_thread::sleep_for(kPollPeriod);
  }
}

}  // namespace posefusion
