#include "posefusion/evaluation/evaluation_report.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"

namespace posefusion {
namespace {

constexpr int kJsonIndent = 2;
constexpr double kPercent = 100;

nlohmann::json StatisticsJson(const ErrorStatistics& statistics, const std::string& unit) {
  nlohmann::json json;
  json["rmse_" + unit] = statistics.rmse;
  json["mean_" + unit] = statistics.mean;
  json["median_" + unit] = statistics.median;
  json["p95_" + unit] = statistics.p95;
  json["std_" + unit] = statistics.std_dev;
  json["min_" + unit] = statistics.min;
  json["max_" + unit] = statistics.max;
  return json;
}

nlohmann::json IntervalsJson(const std::vector<StampInterval>& intervals) {
  nlohmann::json json = nlohmann::json::array();
  for (const StampInterval& interval : intervals) {
    json.push_back({{"begin_s", FormatStamp(interval.begin_ns)},
                    {"end_s", FormatStamp(interval.end_ns)},
                    {"name", interval.name}});
  }
  return json;
}

template <class... Values>
std::string Formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string TableRow(const char* name, const ErrorStatistics& s, const char* unit) {
  return Formatted("%-16s %10.6f %10.6f %10.6f %10.6f %10.6f  %-6s %7d\n", name, s.rmse, s.mean,
                   s.median, s.p95, s.max, unit, s.count);
}

std::string PosesCsv(const AbsoluteError& error) {
  std::string text =
      "stamp_s,truth_x_m,truth_y_m,truth_z_m,estimate_x_m,estimate_y_m,estimate_z_m,"
      "translation_error_m,rotation_error_deg\n";
  for (const PosePair& pair : error.pairs) {
    const Eigen::Vector3d truth = pair.T_map_truth.translation();
    const Eigen::Vector3d estimate = pair.T_map_estimate.translation();
    text += FormatStamp(pair.stamp_ns);
    text += Formatted(",%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", truth.x(), truth.y(), truth.z(),
                      estimate.x(), estimate.y(), estimate.z(), pair.translation_error_m,
                      pair.rotation_error_deg);
  }
  return text;
}

std::string RpeCsv(const RelativeError& error) {
  std::string text = "begin_s,end_s,translation_mps,rotation_degps\n";
  for (const RelativeErrorSample& sample : error.samples) {
    text += FormatStamp(sample.begin_ns) + "," + FormatStamp(sample.end_ns);
    text += Formatted(",%.6f,%.6f\n", sample.translation_m, sample.rotation_deg);
  }
  return text;
}

}  // namespace

nlohmann::json ToJson(const TrajectoryEvaluation& evaluation) {
  const AbsoluteError& absolute = evaluation.absolute;
  const RelativeError& relative = evaluation.relative;
  nlohmann::json json;
  json["ate"] = {{"alignment", ToString(absolute.alignment)},
                 {"pairs", absolute.translation_m.count},
                 {"translation", StatisticsJson(absolute.translation_m, "m")},
                 {"rotation", StatisticsJson(absolute.rotation_deg, "deg")}};
  json["rpe"] = {{"delta_s", 1.0}, {"pairs", relative.translation_mps.count}};
  if (relative.translation_mps.count > 0) {
    json["rpe"]["translation"] = StatisticsJson(relative.translation_mps, "mps");
    json["rpe"]["rotation"] = StatisticsJson(relative.rotation_degps, "degps");
  }
  json["coverage"] = {{"ratio", evaluation.coverage.Ratio()},
                      {"basis", ToString(evaluation.coverage.basis)},
                      {"expected", evaluation.coverage.num_expected},
                      {"covered", evaluation.coverage.num_covered}};
  json["excluded_intervals"] = IntervalsJson(evaluation.excluded);
  return json;
}

std::string FormatTable(const TrajectoryEvaluation& evaluation) {
  const bool aligned = evaluation.absolute.alignment == TrajectoryAlignment::kLeastSquares;
  std::string text = Formatted("%-16s %10s %10s %10s %10s %10s  %-6s %7s\n", "error", "rmse",
                               "mean", "median", "p95", "max", "unit", "poses");
  text += TableRow(aligned ? "ATE" : "from first pose", evaluation.absolute.translation_m, "m");
  text +=
      TableRow(aligned ? "ATE rotation" : "  rotation", evaluation.absolute.rotation_deg, "deg");
  text += TableRow("RPE", evaluation.relative.translation_mps, "m/s");
  text += TableRow("RPE rotation", evaluation.relative.rotation_degps, "deg/s");
  const Coverage& coverage = evaluation.coverage;
  text += Formatted("%-16s %9.2f%% (%d of %d, by %s)\n", "coverage", kPercent * coverage.Ratio(),
                    coverage.num_covered, coverage.num_expected, ToString(coverage.basis));
  if (!aligned) {
    text += "The truth moves less than 1 mm: compared after laying the first poses together.\n";
  }
  return text;
}

void WriteEvaluation(const TrajectoryEvaluation& evaluation, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be created: " + error.message());
  WriteFileAtomically(folder + "/evaluation_poses.csv", PosesCsv(evaluation.absolute));
  WriteFileAtomically(folder + "/evaluation_rpe.csv", RpeCsv(evaluation.relative));
  WriteFileAtomically(folder + "/evaluation.json", ToJson(evaluation).dump(kJsonIndent) + "\n");
}

}  // namespace posefusion
