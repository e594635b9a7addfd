#pragma once

#include <deque>

namespace posefusion {

/// How often keypoints come and how late. Times are seconds; not thread-safe.
class KeypointRateMeter {
 public:
  /// `now_s` of a steady clock; `delay_s` from the image stamp to now.
  void Note(double now_s, double delay_s) {
    times_s_.push_back(now_s);
    delay_s_ = delay_s;
    DropOld(now_s);
  }

  /// Messages per second lately; 0 when none came.
  double RateHz(double now_s) {
    DropOld(now_s);
    return static_cast<double>(times_s_.size()) / kWindowS;
  }

  /// Of the newest message; -1 before the first.
  double delay_s() const { return delay_s_; }

 private:
  static constexpr double kWindowS = 2;

  void DropOld(double now_s) {
    while (!times_s_.empty() && times_s_.front() < now_s - kWindowS) times_s_.pop_front();
  }

  std::deque<double> times_s_;
  double delay_s_ = -1;
};

}  // namespace posefusion
