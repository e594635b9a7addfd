#pragma once

#include <deque>
#include <optional>

namespace posefusion {

/// How often something happened lately and how late it was. Times are seconds of a steady clock;
/// not thread-safe.
class PaceMeter {
 public:
  explicit PaceMeter(double window_s = 10) : window_s_(window_s) {}

  /// `delay_s`: from the image stamp to now.
  void Note(double now_s, double delay_s = 0) {
    if (notes_.empty() && !start_s_) start_s_ = now_s;
    notes_.push_back({now_s, delay_s});
    newest_delay_s_ = delay_s;
    DropOld(now_s);
  }

  /// Per second, over the window or, with more than one, the time since the first one; 0 when
  /// nothing came.
  double RateHz(double now_s);

  /// Of the newest one, in the window or not; -1 before the first.
  double newest_delay_s() const { return newest_delay_s_; }

  /// Quantile of the delays in the window; 0 when nothing came.
  double DelayQuantileS(double share) const;

 private:
  struct Entry {
    double time_s;
    double delay_s;
  };

  void DropOld(double now_s) {
    while (!notes_.empty() && notes_.front().time_s < now_s - window_s_) notes_.pop_front();
  }

  double window_s_;
  std::optional<double> start_s_;
  double newest_delay_s_ = -1;
  std::deque<Entry> notes_;
};

}  // namespace posefusion
