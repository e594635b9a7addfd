#include "tools/suite_time.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "posefusion/common/text_lines.h"

namespace posefusion {
namespace {

constexpr double kFramesPerSecond = 30;
constexpr double kRenderMsPerFrame = 80;  ///< of a simulated frame, at the promised 12 frames/s
constexpr double kEvaluationS = 5;        ///< plots and map evaluation
constexpr int kUnknownFrames = 1000;      ///< half a minute
constexpr int kThreadsPerJob = 2;         ///< of run_dataset
constexpr char kSimulated[] = "sim:";

bool IsSimulated(const SuiteJob& job) { return job.source.rfind(kSimulated, 0) == 0; }

/// The whole number behind `start` in the text; nothing when `start` is not there.
std::optional<int> NumberBehind(const std::string& text, const std::string& start) {
  const std::size_t place = text.find(start);
  if (place == std::string::npos) return std::nullopt;
  return static_cast<int>(std::strtol(text.c_str() + place + start.size(), nullptr, 10));
}

std::optional<int> FramesOfSource(const SuiteJob& job) {
  if (job.frames > 0) return job.frames;
  if (IsSimulated(job)) {
    const auto seconds = NumberBehind(job.source, "seconds=");
    if (!seconds) return std::nullopt;
    return static_cast<int>(*seconds * kFramesPerSecond);
  }
  const std::filesystem::path list = std::filesystem::path(job.source) / "rgb.txt";
  if (!std::filesystem::exists(list)) return std::nullopt;
  return static_cast<int>(ReadTextLines(list).size());
}

std::optional<int> MaxFrames(const SuiteJob& job) {
  const std::string option = "--max-frames";
  for (std::size_t i = 0; i < job.options.size(); ++i) {
    if (job.options[i] == option && i + 1 < job.options.size()) {
      return std::atoi(job.options[i + 1].c_str());
    }
    if (const auto number = NumberBehind(job.options[i], option + "=")) return number;
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> NumFrames(const SuiteJob& job) {
  const auto of_source = FramesOfSource(job);
  const auto max = MaxFrames(job);
  if (!of_source || !max) return of_source ? of_source : max;
  return std::min(*of_source, *max);
}

SuiteTime::SuiteTime(double ms_per_frame, int num_parallel)
    : ms_per_frame_(ms_per_frame), num_parallel_(num_parallel) {}

double SuiteTime::AssumedS(const SuiteJob& job) const {
  const int num_frames = NumFrames(job).value_or(kUnknownFrames);
  const double frame_ms = ms_per_frame_ + (IsSimulated(job) ? kRenderMsPerFrame : 0);
  return kEvaluationS + num_frames * frame_ms / 1000;
}

void SuiteTime::AddPending(const SuiteJob& job) { pending_s_ += AssumedS(job); }

void SuiteTime::AddDone(const SuiteJob& job, double wall_s, bool was_pending) {
  if (was_pending) Drop(job);
  done_assumed_s_ += AssumedS(job);
  done_wall_s_ += wall_s;
}

void SuiteTime::Drop(const SuiteJob& job) {
  pending_s_ = std::max(0.0, pending_s_ - AssumedS(job));
}

double SuiteTime::RemainingS() const {
  if (done_assumed_s_ > 0) return pending_s_ * done_wall_s_ / done_assumed_s_ / num_parallel_;
  const int num_cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return pending_s_ / std::clamp(num_cores / kThreadsPerJob, 1, num_parallel_);
}

}  // namespace posefusion
