#include "tools/suite_figures.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "posefusion/common/atomic_file.h"
#include "posefusion/evaluation/statistics.h"

namespace posefusion {
namespace {

/// Prefix of the figures and the file below the job's folder.
constexpr std::pair<const char*, const char*> kFiles[] = {
    {"report", "report.json"},         {"trajectory", "evaluation.json"},
    {"live", "live/evaluation.json"},  {"map", "map_evaluation.json"},
    {"masks", "mask_evaluation.json"}, {"blur", "blur_evaluation.json"}};

bool IsSameBesideSeed(const SuiteAggregate& aggregate, const SuiteJob& job) {
  return aggregate.name == job.name && aggregate.source_template == job.source_template &&
         aggregate.preset == job.preset;
}

std::map<std::string, FigureSummary> SummarizeAll(const std::vector<const Figures*>& jobs) {
  std::map<std::string, std::vector<double>> values;
  for (const Figures* figures : jobs) {
    for (const auto& [key, value] : *figures) {
      if (value.is_number()) values[key].push_back(value.get<double>());
    }
  }
  std::map<std::string, FigureSummary> summaries;
  for (const auto& [key, numbers] : values) {
    const ErrorStatistics statistics = Summarize(numbers);
    summaries[key] = {statistics.count, statistics.median, statistics.max};
  }
  return summaries;
}

}  // namespace

void Flatten(const nlohmann::json& json, const std::string& key, Figures& figures) {
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) Flatten(value, key + "." + name, figures);
  } else if (json.is_array()) {
    figures[key + ".count"] = json.size();
  } else if (!json.is_null()) {
    figures[key] = json;
  }
}

Figures ReadFigures(const std::string& folder) {
  Figures figures;
  for (const auto& [prefix, file] : kFiles) {
    const std::string path = folder + "/" + file;
    if (!std::filesystem::exists(path)) continue;
    const auto json = nlohmann::json::parse(ReadWholeFile(path), nullptr, /*exceptions=*/false);
    if (!json.is_object()) throw std::runtime_error(path + ": is no JSON object");
    Flatten(json, prefix, figures);
  }
  return figures;
}

std::vector<SuiteAggregate> Aggregate(const std::vector<JobOutcome>& outcomes) {
  std::vector<SuiteAggregate> aggregates;
  std::vector<std::vector<const Figures*>> jobs;
  for (const JobOutcome& outcome : outcomes) {
    const auto found =
        std::find_if(aggregates.begin(), aggregates.end(),
                     [&](const SuiteAggregate& a) { return IsSameBesideSeed(a, outcome.job); });
    const auto index = static_cast<std::size_t>(found - aggregates.begin());
    if (found == aggregates.end()) {
      const SuiteJob& job = outcome.job;
      aggregates.push_back({job.name, job.source_template, job.preset, 0, 0, {}});
      jobs.emplace_back();
    }
    ++aggregates[index].num_jobs;
    if (outcome.result.state != JobState::kDone) continue;
    ++aggregates[index].num_done;
    jobs[index].push_back(&outcome.figures);
  }
  for (std::size_t i = 0; i < aggregates.size(); ++i) aggregates[i].figures = SummarizeAll(jobs[i]);
  return aggregates;
}

}  // namespace posefusion
