#pragma once

#include <string>

namespace posefusion {

/// Runs scripts/plot_trajectory.py on the files that WriteEvaluation left in `folder`; it adds
/// trajectory_top.png, trajectory_axes.png, ate.png and rpe.png. Waits for it; no shell between.
/// Returns why there are no plots, or an empty string when there are.
std::string PlotEvaluation(const std::string& folder);

}  // namespace posefusion
