#include "posefusion/evaluation/mask_report.h"

#include <algorithm>
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

template <class... Values>
std::string Formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::int64_t NumWrong(const FrameMaskScore& frame) {
  return frame.counts.person_missed + frame.counts.static_taken;
}

nlohmann::json FrameJson(const FrameMaskScore& frame) {
  return {{"stamp", FormatStamp(frame.stamp_ns)},
          {"recall", frame.counts.Recall()},
          {"precision", frame.counts.Precision()},
          {"missed_px", frame.counts.person_missed},
          {"taken_px", frame.counts.static_taken}};
}

}  // namespace

std::vector<FrameMaskScore> WorstFrames(const MaskEvaluation& evaluation, int count) {
  std::vector<FrameMaskScore> frames = evaluation.frames;
  std::stable_sort(frames.begin(), frames.end(),
                   [](const auto& a, const auto& b) { return NumWrong(a) > NumWrong(b); });
  if (frames.size() > static_cast<std::size_t>(count))
    frames.resize(static_cast<std::size_t>(count));
  while (!frames.empty() && NumWrong(frames.back()) == 0) frames.pop_back();
  return frames;
}

nlohmann::json ToJson(const MaskEvaluation& evaluation, const MaskEvaluationConfig& config) {
  nlohmann::json json;
  json["frames"] = {{"total", evaluation.frames.size()},
                    {"without_estimate", evaluation.num_without_estimate},
                    {"judged", evaluation.num_judged},
                    {"good", evaluation.num_good},
                    {"good_share", evaluation.GoodShare()}};
  json["pixels"] = {{"person_found", evaluation.pooled.person_found},
                    {"person_missed", evaluation.pooled.person_missed},
                    {"static_taken", evaluation.pooled.static_taken}};
  json["recall"] = evaluation.pooled.Recall();
  json["precision"] = evaluation.pooled.Precision();
  json["iou"] = evaluation.pooled.IntersectionOverUnion();
  json["mean_iou"] = evaluation.MeanIou();
  json["worst_frames"] = nlohmann::json::array();
  for (const FrameMaskScore& frame : WorstFrames(evaluation, config.num_worst)) {
    json["worst_frames"].push_back(FrameJson(frame));
  }
  json["settings"] = {{"rim_px", config.rim_px},
                      {"min_person_px", config.min_person_px},
                      {"good_recall", config.good_recall},
                      {"min_joints", config.min_joints}};
  return json;
}

std::string FormatTable(const MaskEvaluation& evaluation, const MaskEvaluationConfig& config) {
  std::string text = Formatted("%-28s %8.4f\n", "recall", evaluation.pooled.Recall());
  text += Formatted("%-28s %8.4f\n", "precision", evaluation.pooled.Precision());
  text += Formatted("%-28s %8.4f\n", "intersection over union",
                    evaluation.pooled.IntersectionOverUnion());
  text += Formatted("%-28s %8.4f\n", "  mean of the frames", evaluation.MeanIou());
  text += Formatted("%-28s %7.1f%% (%d of %d frames with a person of more than %d px)\n",
                    "frames with enough recall", kPercent * evaluation.GoodShare(),
                    evaluation.num_good, evaluation.num_judged, config.min_person_px);
  text += Formatted("%zu frames, %d of them without a mask\n", evaluation.frames.size(),
                    evaluation.num_without_estimate);
  for (const FrameMaskScore& frame : WorstFrames(evaluation, config.num_worst)) {
    text += Formatted("  %s  recall %.3f  precision %.3f\n", FormatStamp(frame.stamp_ns).c_str(),
                      frame.counts.Recall(), frame.counts.Precision());
  }
  return text;
}

void WriteMaskEvaluation(const MaskEvaluation& evaluation, const MaskEvaluationConfig& config,
                         const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be created: " + error.message());
  WriteFileAtomically(folder + "/mask_evaluation.json",
                      ToJson(evaluation, config).dump(kJsonIndent) + "\n");
}

}  // namespace posefusion
