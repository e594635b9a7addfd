#pragma once

#include <chrono>
#include <vector>

namespace posefusion {

/// Wall time of one stage of one frame.
struct StageTime {
  const char* stage = "";  ///< a string literal
  double milliseconds = 0;
};

/// Collects the stage times of one frame. Not thread-safe.
class StageClock {
 public:
  /// Adds its own life time as a stage when it ends.
  class Scope {
   public:
    Scope(StageClock& clock, const char* stage);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageClock& clock_;
    const char* stage_;
    std::chrono::steady_clock::time_point start_;
  };

  /// Measures until the returned object goes out of scope. `stage` is a string literal.
  Scope Measure(const char* stage) { return Scope(*this, stage); }

  /// Times of the stages measured since the last Clear, in the order in which they ended.
  const std::vector<StageTime>& times() const { return times_; }

  void Clear() { times_.clear(); }

 private:
  std::vector<StageTime> times_;
};

/// The q-quantile (0..1) by the nearest-rank method; 0 for no samples.
double Quantile(std::vector<double> samples, double q);

}  // namespace posefusion
