#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace posefusion {

/// Shows how far a long job is, on standard error: one line that is rewritten on a terminal, a
/// plain line every few seconds otherwise. Not thread-safe.
class Progress {
 public:
  /// `total` is unknown when empty. `unit` is what is counted, in the plural ("frames").
  Progress(std::string title, std::optional<int> total, std::string unit = "frames");

  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// To be called after each step; shows something only now and then.
  void Update(int done);

  /// Shows the last state and ends the line. Further calls do nothing.
  void Finish();

  /// Writes a message without breaking the line.
  void Print(const std::string& text);

 private:
  void Show();

  const std::string title_;
  const std::optional<int> total_;
  const std::string unit_;
  const bool is_terminal_;
  const std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_shown_;
  int done_ = 0;
  bool finished_ = false;
};

/// "run: 120 / 300 frames (40 %), 19.8/s, 9 s left"; without a total "run: 120 frames, 19.8/s".
std::string ProgressText(const std::string& title, int done, std::optional<int> total,
                         const std::string& unit, double elapsed_s);

/// "9 s", "3:05 min" or "1:02:09 h".
std::string DurationText(double seconds);

}  // namespace posefusion
