#pragma once

#include <optional>
#include <string>

#include "posefusion/evaluation/absolute_error.h"
#include "posefusion/evaluation/coverage.h"
#include "posefusion/evaluation/relative_error.h"

namespace posefusion {

/// What is known beside the two trajectories.
struct EvaluationContext {
  std::vector<StampInterval> excluded;                  ///< no pose is expected in these
  std::optional<std::vector<StampNs>> expected_frames;  ///< frames that should have a pose
  std::optional<FrameCounts> frame_counts;
};

/// How good an estimated trajectory is.
struct TrajectoryEvaluation {
  AbsoluteError absolute;
  RelativeError relative;
  Coverage coverage;  ///< by the best basis that the context has
  std::vector<StampInterval> excluded;
};

/// Errors and coverage of a trajectory. Both trajectories are in stamp order, poses of the same
/// body, each in its own map frame.
/// @throws std::runtime_error when fewer than three poses can be associated.
TrajectoryEvaluation EvaluateTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                        const EvaluationContext& context = {});

/// Files of an evaluation; an empty path stands for "none".
struct EvaluationFiles {
  std::string groundtruth;
  std::string estimate;
  std::string exclude;  ///< events.txt
  std::string frames;   ///< list of frames; when empty, frames.txt beside the estimate if present
};

/// Reads the files, and frames.txt and report.json beside the estimate where they exist.
/// @throws std::runtime_error naming the file that cannot be read or evaluated.
TrajectoryEvaluation EvaluateFiles(const EvaluationFiles& files);

}  // namespace posefusion
