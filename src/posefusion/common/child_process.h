#pragma once

#include <functional>
#include <string>
#include <vector>

namespace posefusion {

/// How a program ended.
struct ChildExit {
  int code = -1;         ///< exit code; -1 when it did not exit by itself
  int signal = 0;        ///< signal that ended it, 0 for none
  bool stopped = false;  ///< was asked to end

  bool IsSuccess() const { return code == 0 && !stopped; }
};

/// Runs a program without a shell and waits for its end. Its output and errors are appended to
/// `log_path`; its standard input is empty. It gets a process group of its own, so that a Ctrl-C on
/// the terminal reaches the caller alone. When `should_stop` becomes true the group is asked to end
/// (SIGTERM), and killed after `grace_s`. May be called from several threads at once.
/// @throws std::runtime_error naming the program or the log file that cannot be opened.
ChildExit RunChild(const std::vector<std::string>& command, const std::string& log_path,
                   const std::function<bool()>& should_stop, double grace_s = 60);

}  // namespace posefusion
