#pragma once

#include <atomic>
#include <csignal>

namespace posefusion {

/// Set by the first Ctrl-C (or SIGTERM) after CatchInterrupts(); a second one ends the program.
inline std::atomic<bool> interrupted{false};

inline void CatchInterrupts() {
  static_assert(std::atomic<bool>::is_always_lock_free);
  const auto handler = [](int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

}  // namespace posefusion
