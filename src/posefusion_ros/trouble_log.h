#pragma once

#include <functional>
#include <string>

namespace posefusion {

/// Turns trouble that repeats with every frame into few log lines: a text is passed on when it is
/// new or the last line was long ago, and the end of the trouble is told once. Not thread-safe.
class TroubleLog {
 public:
  using Sink = std::function<void(const std::string& text)>;

  /// `error` and `info` write the lines.
  TroubleLog(double period_s, Sink error, Sink info);

  /// `now_s` is any steady clock in seconds.
  void Report(const std::string& text, double now_s);

  /// Tells that all is well again; costs nothing when it has been well before.
  void AllWell();

  /// The last report; empty when all is well.
  const std::string& trouble() const { return last_text_; }

 private:
  const double period_s_;
  const Sink error_;
  const Sink info_;
  std::string last_text_;
  double last_line_s_ = 0;
  int num_reports_ = 0;
};

/// Seconds of a clock that never jumps.
double SteadyNowS();

}  // namespace posefusion
