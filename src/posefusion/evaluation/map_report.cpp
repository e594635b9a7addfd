#include "posefusion/evaluation/map_report.h"

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
constexpr double kMillimetresPerMetre = 1000;

template <class... Values>
std::string Formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

nlohmann::json ErrorsJson(const ErrorStatistics& errors) {
  nlohmann::json json = {{"count", errors.count}};
  if (errors.count == 0) return json;
  json["mean_m"] = errors.mean;
  json["median_m"] = errors.median;
  json["p95_m"] = errors.p95;
  json["rmse_m"] = errors.rmse;
  json["max_m"] = errors.max;
  return json;
}

nlohmann::json GhostsJson(const GhostFigures& ghosts) {
  return {{"count", ghosts.count}, {"share", ghosts.share}, {"area_cm2", ghosts.area_cm2}};
}

nlohmann::json SettingsJson(const MapEvaluationConfig& config) {
  return {{"min_confidence", config.min_confidence},
          {"near_m", config.near_m},
          {"far_m", config.far_m},
          {"covered_distance_m", config.covered_distance_m},
          {"ghost_distance_m", config.ghost_distance_m},
          {"person_margin_m", config.person_margin_m},
          {"union_thickness_m", config.union_thickness_m},
          {"samples_per_m2", config.samples_per_m2},
          {"view_period_s", config.view_period_s},
          {"seed", config.seed}};
}

std::string ErrorRow(const std::string& name, const ErrorStatistics& errors) {
  return Formatted("%-24s %10.2f %10.2f %10.2f  %-4s %9d\n", name.c_str(),
                   kMillimetresPerMetre * errors.mean, kMillimetresPerMetre * errors.median,
                   kMillimetresPerMetre * errors.p95, "mm", errors.count);
}

std::string GhostRow(const char* name, const GhostFigures& ghosts) {
  return Formatted("%-24s %9.3f%% (%d surfels, %.1f cm2)\n", name, kPercent * ghosts.share,
                   ghosts.count, ghosts.area_cm2);
}

}  // namespace

nlohmann::json ToJson(const MapEvaluation& evaluation, const MapEvaluationConfig& config) {
  nlohmann::json json;
  json["alignment"] = {{"method", "views"}, {"pairs", evaluation.num_pairs}};
  json["surfels"] = {{"total", evaluation.num_surfels},
                     {"stable", evaluation.num_stable},
                     {"unknown_distance", evaluation.num_unknown_distance}};
  json["surface_error"] = {{"all", ErrorsJson(evaluation.all_m)},
                           {"near", ErrorsJson(evaluation.near_m)},
                           {"far", ErrorsJson(evaluation.far_m)}};
  json["completeness"] = {{"ratio", evaluation.Completeness()},
                          {"seen_m2", evaluation.seen_m2},
                          {"covered_m2", evaluation.covered_m2}};
  json["ghosts"] = {{"off_surface", GhostsJson(evaluation.off_surface)}};
  if (evaluation.people) json["ghosts"]["people"] = GhostsJson(*evaluation.people);
  json["settings"] = SettingsJson(config);
  return json;
}

std::string FormatTable(const MapEvaluation& evaluation, const MapEvaluationConfig& config) {
  std::string text = Formatted("%-24s %10s %10s %10s  %-4s %9s\n", "surface error", "mean",
                               "median", "p95", "unit", "surfels");
  text += ErrorRow(Formatted("measured within %.1f m", config.near_m), evaluation.near_m);
  text += ErrorRow(Formatted("measured within %.1f m", config.far_m), evaluation.far_m);
  text += ErrorRow("all", evaluation.all_m);
  text += Formatted("%-24s %9.2f%% (%.2f of %.2f m2 seen within %.1f m)\n", "completeness",
                    kPercent * evaluation.Completeness(), evaluation.covered_m2, evaluation.seen_m2,
                    config.near_m);
  text += GhostRow("ghosts off surfaces", evaluation.off_surface);
  if (evaluation.people) {
    text += GhostRow("ghosts where people were", *evaluation.people);
  } else {
    text += Formatted("%-24s %10s\n", "ghosts where people were", "unknown");
  }
  text += Formatted("%d of %d surfels are stable; aligned by %d views\n", evaluation.num_stable,
                    evaluation.num_surfels, evaluation.num_pairs);
  return text;
}

void WriteMapEvaluation(const MapEvaluation& evaluation, const MapEvaluationConfig& config,
                        const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be created: " + error.message());
  WriteFileAtomically(folder + "/map_evaluation.json",
                      ToJson(evaluation, config).dump(kJsonIndent) + "\n");
}

}  // namespace posefusion
