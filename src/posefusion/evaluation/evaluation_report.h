#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "posefusion/evaluation/trajectory_evaluation.h"

namespace posefusion {

/// All figures with their units in the keys (_m, _deg, _mps, _degps); without the single poses.
nlohmann::json ToJson(const TrajectoryEvaluation& evaluation);

/// A few lines for a terminal.
std::string FormatTable(const TrajectoryEvaluation& evaluation);

/// Writes evaluation.json, evaluation_poses.csv (true and aligned estimated positions with their
/// errors) and evaluation_rpe.csv into `folder`, which is created when it does not exist.
/// @throws std::runtime_error naming what cannot be written.
void WriteEvaluation(const TrajectoryEvaluation& evaluation, const std::string& folder);

}  // namespace posefusion
