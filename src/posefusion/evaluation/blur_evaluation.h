#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/evaluation/intervals.h"

namespace posefusion {

/// A frame, what its blur truly is, and what the blur filter did with it.
struct JudgedFrame {
  StampNs stamp_ns = 0;
  double length_px = 0;  ///< true blur by the camera's motion
  bool dropped = false;
};

struct BlurEvaluationConfig {
  double blurred_px = 4;  ///< longer true blur ought to be dropped
  double still_px = 1;    ///< up to this the image counts as standing still
};

/// How many frames were rightly and wrongly dropped.
struct BlurFigures {
  int num_blurred = 0;
  int num_found = 0;  ///< of the blurred: dropped
  int num_sharp = 0;
  int num_false = 0;  ///< of the sharp: dropped

  double Recall() const;      ///< 0..1; 1 when nothing is blurred
  double FalseShare() const;  ///< 0..1 of the sharp frames
};

struct BlurEvaluation {
  BlurFigures all;
  BlurFigures in_events;       ///< of frames within the events, such as falls
  BlurFigures outside_events;  ///< of the others
  /// The longest time without a kept frame while the image stood still, as in front of a wall: from
  /// the first dropped frame of the run to the first frame after it.
  double longest_still_drop_s = 0;
};

/// Joins blur.txt of a simulated run (`stamp blur_px`) with frames.txt of run_dataset
/// (`stamp state`; states that begin with "dropped_blur" are dropped frames), in stamp order.
/// Frames that frames.txt does not have are left out: a source may deliver fewer.
/// @throws std::runtime_error naming file and line for anything else, an unreadable file, and a
///   frame without a true length.
std::vector<JudgedFrame> ReadJudgedFrames(const std::string& blur_path,
                                          const std::string& frames_path);

/// `frames` in stamp order.
BlurEvaluation EvaluateBlur(const std::vector<JudgedFrame>& frames,
                            const std::vector<StampInterval>& events,
                            const BlurEvaluationConfig& config);

nlohmann::json ToJson(const BlurEvaluation& evaluation, const BlurEvaluationConfig& config);

/// A few lines for a terminal.
std::string FormatTable(const BlurEvaluation& evaluation, const BlurEvaluationConfig& config);

/// Writes blur_evaluation.json into `folder`, which is created when it does not exist.
/// @throws std::runtime_error naming what cannot be written.
void WriteBlurEvaluation(const BlurEvaluation& evaluation, const BlurEvaluationConfig& config,
                         const std::string& folder);

}  // namespace posefusion
