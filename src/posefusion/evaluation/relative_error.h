#pragma once

#include <vector>

#include "posefusion/common/trajectory.h"
#include "posefusion/evaluation/intervals.h"
#include "posefusion/evaluation/statistics.h"

namespace posefusion {

/// Drift between two moments about one second apart.
struct RelativeErrorSample {
  StampNs begin_ns = 0;
  StampNs end_ns = 0;
  double translation_m = 0;
  double rotation_deg = 0;
};

/// Relative pose error over one second, hence per second.
struct RelativeError {
  std::vector<RelativeErrorSample> samples;  ///< in order of their begin
  ErrorStatistics translation_mps;           ///< its rmse is the RPE
  ErrorStatistics rotation_degps;
};

/// RPE as the script evaluate_rpe of the TUM RGB-D benchmark has it with --fixed_delta and a delta
/// of 1 s (Sturm 2012): each estimated pose is paired with the one whose stamp is closest to a
/// second later (never the last, which stands for "beyond the end"), the truth is taken at the
/// closest stamps, and pairs without a true pose within twice the truth's median period are left
/// out. Of several poses with one stamp the last counts. Pairs that touch an `excluded` interval do
/// not count. No samples when nothing remains.
RelativeError ComputeRelativeError(const Trajectory& all_truth, const Trajectory& all_estimate,
                                   const std::vector<StampInterval>& excluded = {});

}  // namespace posefusion
