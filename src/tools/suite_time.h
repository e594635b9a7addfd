#pragma once

#include <optional>
#include <string>

#include "tools/suite_list.h"

namespace posefusion {

/// How many frames a job works on, as far as it can be told without opening the images: `frames` of
/// the list, lines of rgb.txt of a folder, or seconds x 30 Hz of a simulated source, and at most
/// --max-frames of the options. Nothing for a bag without `frames`.
std::optional<int> NumFrames(const SuiteJob& job);

/// Guesses how long jobs take: frames x assumed milliseconds a frame at first, in proportion to the
/// jobs that have been done as soon as there are any.
class SuiteTime {
 public:
  /// `num_parallel` jobs share the cores.
  SuiteTime(double ms_per_frame, int num_parallel);

  void AddPending(const SuiteJob& job);

  /// A job that has taken `wall_s`. `was_pending` when it had been added before.
  void AddDone(const SuiteJob& job, double wall_s, bool was_pending);

  /// Takes a job out that will not be done.
  void Drop(const SuiteJob& job);

  /// Until all pending jobs are done.
  double RemainingS() const;

 private:
  double AssumedS(const SuiteJob& job) const;

  double ms_per_frame_;
  int num_parallel_;
  double pending_s_ = 0;  ///< assumed, on free cores
  double done_assumed_s_ = 0;
  double done_wall_s_ = 0;
};

}  // namespace posefusion
