#pragma once

#include <optional>
#include <string>
#include <vector>

#include "posefusion/common/trajectory.h"
#include "posefusion/evaluation/intervals.h"

namespace posefusion {

/// What the frames that should have a pose are known from, the best first.
enum class CoverageBasis {
  kFrames,  ///< a list of the frames
  kReport,  ///< the counts in the report.json of run_dataset
  kTruth,   ///< the samples of the ground truth, where nothing is known of the frames
};

const char* ToString(CoverageBasis basis);

/// Share of the frames (or moments) that have a pose among those that should have one.
struct Coverage {
  CoverageBasis basis = CoverageBasis::kTruth;
  int num_expected = 0;
  int num_covered = 0;

  /// 0..1; 1 when nothing is expected.
  double Ratio() const;
};

/// Numbers of frames as report.json has them.
struct FrameCounts {
  int total = 0;
  int dropped_blur = 0;  ///< frames left out on purpose
};

/// Reads a list of frames: a line `stamp [state ...]` each, so that rgb.txt will do. Frames whose
/// state starts with "dropped" are left out on purpose and are not returned.
/// @throws std::runtime_error naming file and line for a malformed stamp, and an unreadable file.
std::vector<StampNs> ReadExpectedFrames(const std::string& path);

/// frames.total and frames.dropped_blur of a report.json; nothing when there is no such file.
/// @throws std::runtime_error naming a file without these numbers.
std::optional<FrameCounts> ReadFrameCounts(const std::string& path);

/// Share of the given frames outside `excluded` whose stamp (to 1 ms) is in the estimate.
Coverage CoverageOfFrames(const Trajectory& estimate, const std::vector<StampNs>& frames_ns,
                          const std::vector<StampInterval>& excluded);

/// Number of poses over the number of frames not dropped. Only for runs without excluded intervals,
/// since counts do not tell how many frames lie inside them.
Coverage CoverageOfCounts(const Trajectory& estimate, const FrameCounts& counts);

/// Share of the truth's samples outside `excluded` that have an estimated pose within 0.1 s.
Coverage CoverageOfTruth(const Trajectory& estimate, const Trajectory& truth,
                         const std::vector<StampInterval>& excluded);

}  // namespace posefusion
