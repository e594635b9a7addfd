#pragma once

#include <string>
#include <vector>

#include "tools/suite_figures.h"

namespace posefusion {

/// A row per job: name, source, preset, seed, state, and a column for each figure of any job.
std::string SuiteCsv(const std::vector<JobOutcome>& outcomes);

/// A row per figure of each aggregate: name, source, preset, figure, seeds, median, max.
std::string SummaryCsv(const std::vector<SuiteAggregate>& aggregates);

/// Both as JSON: {version, jobs: [...], aggregates: [...]}.
nlohmann::json SuiteJson(const std::vector<JobOutcome>& outcomes);

/// The main figures of the aggregates for a terminal, each as "median (max)".
std::string SuiteTable(const std::vector<SuiteAggregate>& aggregates);

/// Writes suite.csv, suite_summary.csv and suite.json.
/// @throws std::runtime_error naming a file that cannot be written.
void WriteSuite(const std::vector<JobOutcome>& outcomes, const std::string& folder);

}  // namespace posefusion
