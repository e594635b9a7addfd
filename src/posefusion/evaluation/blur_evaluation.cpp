#include "posefusion/evaluation/blur_evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/text_lines.h"

namespace posefusion {
namespace {

constexpr char kDroppedState[] = "dropped_blur";
constexpr StampNs kLastFrameNs = 33'333'333;  ///< how long the last frame of a run counts
constexpr int kJsonIndent = 2;
constexpr double kPercent = 100;

std::optional<double> ParseLength(const std::string& text) {
  char* end = nullptr;
  const double length = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(length) || length < 0) return std::nullopt;
  return length;
}

std::map<StampNs, double> ReadLengths(const std::string& path) {
  std::map<StampNs, double> lengths_px;
  for (const TextLine& line : ReadTextLines(path)) {
    const auto stamp_ns = ParseStamp(line.columns[0]);
    const auto length_px = line.columns.size() == 2 ? ParseLength(line.columns[1]) : std::nullopt;
    if (!stamp_ns || !length_px) {
      throw std::runtime_error(LineName(path, line) + ": expected 'stamp blur_px'");
    }
    lengths_px[*stamp_ns] = *length_px;
  }
  return lengths_px;
}

void Count(const JudgedFrame& frame, const BlurEvaluationConfig& config, BlurFigures& figures) {
  const bool blurred = frame.length_px > config.blurred_px;
  ++(blurred ? figures.num_blurred : figures.num_sharp);
  if (frame.dropped) ++(blurred ? figures.num_found : figures.num_false);
}

double LongestStillDrop(const std::vector<JudgedFrame>& frames, double still_px) {
  double longest_s = 0;
  std::optional<StampNs> begin_ns;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool counts = frames[i].dropped && frames[i].length_px <= still_px;
    if (!counts) begin_ns.reset();
    if (!counts) continue;
    if (!begin_ns) begin_ns = frames[i].stamp_ns;
    const StampNs end_ns =
        i + 1 < frames.size() ? frames[i + 1].stamp_ns : frames[i].stamp_ns + kLastFrameNs;
    longest_s = std::max(longest_s, SecondsBetween(*begin_ns, end_ns));
  }
  return longest_s;
}

nlohmann::json FiguresJson(const BlurFigures& figures) {
  nlohmann::json json = {{"blurred", figures.num_blurred},
                         {"found", figures.num_found},
                         {"sharp", figures.num_sharp},
                         {"false_drops", figures.num_false}};
  if (figures.num_blurred > 0) json["recall"] = figures.Recall();
  if (figures.num_sharp > 0) json["false_share"] = figures.FalseShare();
  return json;
}

std::string Row(const char* name, const BlurFigures& figures) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%-16s %8d %8d %8.1f%% %8d %8d %8.2f%%\n", name,
                figures.num_blurred, figures.num_found, kPercent * figures.Recall(),
                figures.num_sharp, figures.num_false, kPercent * figures.FalseShare());
  return text.data();
}

}  // namespace

double BlurFigures::Recall() const {
  return num_blurred == 0 ? 1.0 : static_cast<double>(num_found) / num_blurred;
}

double BlurFigures::FalseShare() const {
  return num_sharp == 0 ? 0.0 : static_cast<double>(num_false) / num_sharp;
}

std::vector<JudgedFrame> ReadJudgedFrames(const std::string& blur_path,
                                          const std::string& frames_path) {
  const std::map<StampNs, double> lengths_px = ReadLengths(blur_path);
  std::vector<JudgedFrame> frames;
  for (const TextLine& line : ReadTextLines(frames_path)) {
    const auto stamp_ns = ParseStamp(line.columns[0]);
    if (!stamp_ns || line.columns.size() < 2) {
      throw std::runtime_error(LineName(frames_path, line) + ": expected 'stamp state'");
    }
    const auto length = lengths_px.find(*stamp_ns);
    if (length == lengths_px.end()) {
      throw std::runtime_error(LineName(frames_path, line) + ": " + blur_path +
                               " has no frame of this stamp");
    }
    frames.push_back({*stamp_ns, length->second, line.columns[1].rfind(kDroppedState, 0) == 0});
  }
  return frames;
}

BlurEvaluation EvaluateBlur(const std::vector<JudgedFrame>& frames,
                            const std::vector<StampInterval>& events,
                            const BlurEvaluationConfig& config) {
  BlurEvaluation evaluation;
  for (const JudgedFrame& frame : frames) {
    Count(frame, config, evaluation.all);
    const bool in_event = IsInside(frame.stamp_ns, events);
    Count(frame, config, in_event ? evaluation.in_events : evaluation.outside_events);
  }
  evaluation.longest_still_drop_s = LongestStillDrop(frames, config.still_px);
  return evaluation;
}

nlohmann::json ToJson(const BlurEvaluation& evaluation, const BlurEvaluationConfig& config) {
  nlohmann::json json = FiguresJson(evaluation.all);
  json["in_events"] = FiguresJson(evaluation.in_events);
  json["outside_events"] = FiguresJson(evaluation.outside_events);
  json["longest_still_drop_s"] = evaluation.longest_still_drop_s;
  json["settings"] = {{"blurred_px", config.blurred_px}, {"still_px", config.still_px}};
  return json;
}

std::string FormatTable(const BlurEvaluation& evaluation, const BlurEvaluationConfig& config) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%-16s %8s %8s %9s %8s %8s %9s\n", "frames", "blurred",
                "found", "recall", "sharp", "dropped", "share");
  std::string table = text.data();
  table += Row("all", evaluation.all) + Row("in events", evaluation.in_events) +
           Row("outside events", evaluation.outside_events);
  std::snprintf(text.data(), text.size(),
                "blurred: more than %.1f px; longest time dropped at %.1f px or less: %.2f s\n",
                config.blurred_px, config.still_px, evaluation.longest_still_drop_s);
  return table + text.data();
}

void WriteBlurEvaluation(const BlurEvaluation& evaluation, const BlurEvaluationConfig& config,
                         const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be created: " + error.message());
  WriteFileAtomically(folder + "/blur_evaluation.json",
                      ToJson(evaluation, config).dump(kJsonIndent) + "\n");
}

}  // namespace posefusion
