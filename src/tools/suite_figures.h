#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/suite_job.h"

namespace posefusion {

/// Figures of a job by flat keys such as "trajectory.ate.translation.rmse_m": report.* of
/// report.json, trajectory.* and live.* of the two evaluation.json, map.* of map_evaluation.json,
/// masks.* of mask_evaluation.json, blur.* of blur_evaluation.json.
using Figures = std::map<std::string, nlohmann::json>;

/// Adds the scalars of `json` with their path, joined by dots, to `figures`. Of a list its length
/// is taken, as "key.count".
void Flatten(const nlohmann::json& json, const std::string& key, Figures& figures);

/// The figures in a job's folder. @throws std::runtime_error naming a file that is no JSON.
Figures ReadFigures(const std::string& folder);

/// How one job of a suite went.
struct JobOutcome {
  SuiteJob job;
  JobResult result;
  Figures figures;  ///< of a failed job those that it has written before
};

/// Median and maximum of a figure over the seeds.
struct FigureSummary {
  int count = 0;
  double median = 0;
  double max = 0;
};

/// Jobs that differ only in their seed, and all numeric figures of those that are done.
struct SuiteAggregate {
  std::string name;
  std::string source_template;
  std::string preset;
  int num_jobs = 0;
  int num_done = 0;
  std::map<std::string, FigureSummary> figures;
};

/// In the order in which the sources and presets first come.
std::vector<SuiteAggregate> Aggregate(const std::vector<JobOutcome>& outcomes);

}  // namespace posefusion
