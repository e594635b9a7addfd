#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "posefusion/evaluation/mask_evaluation.h"

namespace posefusion {

/// Frames by how many pixels are wrong, most first; frames without a wrong pixel are left out.
std::vector<FrameMaskScore> WorstFrames(const MaskEvaluation& evaluation, int count);

/// All figures, the worst frames by stamp, and the settings that they rest on.
nlohmann::json ToJson(const MaskEvaluation& evaluation, const MaskEvaluationConfig& config);

/// A few lines for a terminal.
std::string FormatTable(const MaskEvaluation& evaluation, const MaskEvaluationConfig& config);

/// Writes mask_evaluation.json into `folder`, which is created when it does not exist.
/// @throws std::runtime_error naming what cannot be written.
void WriteMaskEvaluation(const MaskEvaluation& evaluation, const MaskEvaluationConfig& config,
                         const std::string& folder);

}  // namespace posefusion
