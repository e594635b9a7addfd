#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "posefusion/evaluation/map_evaluation.h"

namespace posefusion {

/// All figures with their units in the keys, and the settings that they rest on.
nlohmann::json ToJson(const MapEvaluation& evaluation, const MapEvaluationConfig& config);

/// A few lines for a terminal.
std::string FormatTable(const MapEvaluation& evaluation, const MapEvaluationConfig& config);

/// Writes map_evaluation.json into `folder`, which is created when it does not exist.
/// @throws std::runtime_error naming what cannot be written.
void WriteMapEvaluation(const MapEvaluation& evaluation, const MapEvaluationConfig& config,
                        const std::string& folder);

}  // namespace posefusion
