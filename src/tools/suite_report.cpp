#include "tools/suite_report.h"

#include <array>
#include <cstdio>
#include <set>

#include "posefusion/common/atomic_file.h"

namespace posefusion {
namespace {

using Json = nlohmann::json;

constexpr int kJsonIndent = 2;

/// A column of the table on the terminal.
struct TableColumn {
  const char* title;
  const char* figure;
  double factor;  ///< from the figure's unit to the title's
};

constexpr TableColumn kColumns[] = {
    {"ATE cm", "trajectory.ate.translation.rmse_m", 100},
    {"live cm", "live.ate.translation.rmse_m", 100},
    {"coverage %", "trajectory.coverage.ratio", 100},
    {"surface mm", "map.surface_error.near.median_m", 1000},
    {"complete %", "map.completeness.ratio", 100},
    {"ghosts cm2", "map.ghosts.off_surface.area_cm2", 1},
    {"recall %", "masks.recall", 100},
    {"precision %", "masks.precision", 100},
    {"good masks %", "masks.frames.good_share", 100},
    {"frame ms", "report.frame_ms.median", 1},
};

/// A value of a CSV file, quoted where it has to be (RFC 4180).
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string ValueText(const nlohmann::json& value) {
  return value.is_string() ? Quoted(value.get<std::string>()) : value.dump();
}

std::string NumberText(double value) { return nlohmann::json(value).dump(); }

Json JobJson(const JobOutcome& outcome) {
  Json json = {{"name", outcome.job.name},           {"source", outcome.job.source},
               {"preset", outcome.job.preset},       {"seed", outcome.job.seed},
               {"folder", "jobs/" + outcome.job.id}, {"state", ToString(outcome.result.state)}};
  if (!outcome.result.problem.empty()) json["problem"] = outcome.result.problem;
  if (outcome.result.state == JobState::kDone) json["wall_s"] = outcome.result.record.wall_s;
  json["figures"] = Json::object();
  for (const auto& [key, value] : outcome.figures) json["figures"][key] = value;
  return json;
}

Json AggregateJson(const SuiteAggregate& aggregate) {
  Json json = {{"name", aggregate.name},     {"source", aggregate.source_template},
               {"preset", aggregate.preset}, {"jobs", aggregate.num_jobs},
               {"done", aggregate.num_done}, {"figures", Json::object()}};
  for (const auto& [key, summary] : aggregate.figures) {
    json["figures"][key] = {
        {"count", summary.count}, {"median", summary.median}, {"max", summary.max}};
  }
  return json;
}

std::string CellText(const SuiteAggregate& aggregate, const TableColumn& column) {
  const auto found = aggregate.figures.find(column.figure);
  if (found == aggregate.figures.end()) return "-";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.2f (%.2f)", column.factor * found->second.median,
                column.factor * found->second.max);
  return text.data();
}

}  // namespace

std::string SuiteCsv(const std::vector<JobOutcome>& outcomes) {
  std::set<std::string> keys;
  for (const JobOutcome& outcome : outcomes) {
    for (const auto& figure : outcome.figures) keys.insert(figure.first);
  }
  std::string text = "name,source,preset,seed,state";
  for (const std::string& key : keys) text += "," + Quoted(key);
  text += "\n";
  for (const JobOutcome& outcome : outcomes) {
    text += outcome.job.name + "," + Quoted(outcome.job.source) + "," + outcome.job.preset + "," +
            std::to_string(outcome.job.seed) + "," + ToString(outcome.result.state);
    for (const std::string& key : keys) {
      const auto found = outcome.figures.find(key);
      text += ",";
      if (found != outcome.figures.end()) text += ValueText(found->second);
    }
    text += "\n";
  }
  return text;
}

std::string SummaryCsv(const std::vector<SuiteAggregate>& aggregates) {
  std::string text = "name,source,preset,figure,seeds,median,max\n";
  for (const SuiteAggregate& aggregate : aggregates) {
    const std::string start =
        aggregate.name + "," + Quoted(aggregate.source_template) + "," + aggregate.preset + ",";
    for (const auto& [key, summary] : aggregate.figures) {
      text += start + Quoted(key) + "," + std::to_string(summary.count) + "," +
              NumberText(summary.median) + "," + NumberText(summary.max) + "\n";
    }
  }
  return text;
}

nlohmann::json SuiteJson(const std::vector<JobOutcome>& outcomes) {
  nlohmann::json json = {{"version", POSEFUSION_VERSION},
                         {"jobs", nlohmann::json::array()},
                         {"aggregates", nlohmann::json::array()}};
  for (const JobOutcome& outcome : outcomes) json["jobs"].push_back(JobJson(outcome));
  for (const SuiteAggregate& aggregate : Aggregate(outcomes)) {
    json["aggregates"].push_back(AggregateJson(aggregate));
  }
  return json;
}

std::string SuiteTable(const std::vector<SuiteAggregate>& aggregates) {
  std::array<char, 128> cell{};
  const auto add = [&](std::string& line, int width, const std::string& text) {
    std::snprintf(cell.data(), cell.size(), "%*s ", width, text.c_str());
    line += cell.data();
  };
  std::string table = "median (max) over the seeds that are done\n";
  add(table, -28, "run / preset");
  add(table, 8, "done");
  for (const TableColumn& column : kColumns) add(table, 18, column.title);
  for (const SuiteAggregate& aggregate : aggregates) {
    table += "\n";
    add(table, -28, aggregate.name + " / " + aggregate.preset);
    add(table, 8, std::to_string(aggregate.num_done) + "/" + std::to_string(aggregate.num_jobs));
    for (const TableColumn& column : kColumns) add(table, 18, CellText(aggregate, column));
    table += " " + aggregate.source_template;
  }
  return table + "\n";
}

void WriteSuite(const std::vector<JobOutcome>& outcomes, const std::string& folder) {
  WriteFileAtomically(folder + "/suite.csv", SuiteCsv(outcomes));
  WriteFileAtomically(folder + "/suite_summary.csv", SummaryCsv(Aggregate(outcomes)));
  WriteFileAtomically(folder + "/suite.json", SuiteJson(outcomes).dump(kJsonIndent) + "\n");
}

}  // namespace posefusion
