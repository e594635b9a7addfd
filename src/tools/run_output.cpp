#include "run_output.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/stage_clock.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"

namespace posefusion {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kKilobytesPerMegabyte = 1024;
constexpr double kMedian = 0.5;
constexpr double kP95 = 0.95;

/// Three decimals are enough for milliseconds.
double Rounded(double value) { return std::round(value * 1000) / 1000; }

Json Summary(const std::vector<double>& samples) {
  return {{"median", Rounded(Quantile(samples, kMedian))},
          {"p95", Rounded(Quantile(samples, kP95))}};
}

double PeakRssMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kKilobytesPerMegabyte;
}

/// Yaml maps of scalars as json, numbers and truth values as such.
Json ToJson(const YAML::Node& node) {
  if (node.IsMap()) {
    Json object = Json::object();
    for (const auto& entry : node) object[entry.first.as<std::string>()] = ToJson(entry.second);
    return object;
  }
  const auto text = node.as<std::string>();
  if (text == "true" || text == "false") return text == "true";
  double number = 0;
  if (YAML::convert<double>::decode(node, number)) return number;
  return text;
}

std::string FramesText(const OfflineRun& run) {
  std::string text = "# stamp state\n";
  for (const FrameRecord& frame : run.frames) {
    text += FormatStamp(frame.stamp_ns) + " " + ToString(frame.state) + "\n";
  }
  return text;
}

}  // namespace

void PrepareOutputFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be made: " + error.message());
  const std::string probe = folder + "/.writable";
  WriteFileAtomically(probe, "");
  std::filesystem::remove(probe, error);
}

std::string ReportJson(const OfflineRun& run, const SystemConfig& config,
                       const std::string& odometry) {
  Json report;
  report["frames"] = {{"total", run.frames.size()},
                      {"dropped_blur", run.Count(FrameState::kDroppedBlur)},
                      {"tracked", run.Count(FrameState::kTracked)},
                      {"lost", run.Count(FrameState::kLost)},
                      {"unreadable", run.num_bad_frames}};
  report["keypoints"] = {{"arrived", run.num_keypoints},
                         {"used", run.keypoints.used},
                         {"unmatched", run.keypoints.unmatched}};
  report["frames"]["with_people"] = run.num_frames_with_people;
  const auto priors = [&](PriorUse use) { return run.priors.count(use) ? run.priors.at(use) : 0; };
  report["odometry_prior"] = {{"used", priors(PriorUse::kUsed)},
                              {"contradicted", priors(PriorUse::kContradicted)},
                              {"distrusted", priors(PriorUse::kDistrusted)}};
  report["keyframes"] = run.num_keyframes;
  report["loops"] = {{"local", 0}, {"global", 0}};
  report["relocalisations"] = run.num_relocalisations;
  report["surfels"] = run.num_surfels;
  report["surfels_exported"] = run.map.size();
  report["stage_ms"] = Json::object();
  for (const auto& [stage, samples] : run.stage_ms) report["stage_ms"][stage] = Summary(samples);
  report["frame_ms"] = Summary(run.frame_ms);
  report["frame_ms"]["max"] = Rounded(Quantile(run.frame_ms, 1));
  report["wall_s"] = Rounded(run.wall_s);
  report["peak_rss_mb"] = Rounded(PeakRssMb());
  report["config"] = ToJson(ToYaml(config));
  report["config"]["odometry"] = odometry;
  report["version"] = POSEFUSION_VERSION;
  return report.dump(2) + "\n";
}

void WriteRunOutput(const OfflineRun& run, const SystemConfig& config, const std::string& odometry,
                    const std::string& folder) {
  const std::vector<std::function<void()>> files = {
      [&] { WriteTrajectory(run.trajectory, folder + "/trajectory.txt"); },
      [&] { WriteTrajectory(run.trajectory_live, folder + "/trajectory_live.txt"); },
      [&] { WriteFileAtomically(folder + "/frames.txt", FramesText(run)); },
      [&] { WritePly(run.map, folder + "/map.ply"); },
      [&] { WriteFileAtomically(folder + "/report.json", ReportJson(run, config, odometry)); }};
  std::exception_ptr first_error;
  for (const auto& write : files) {
    try {
      write();
    } catch (const std::exception&) {
      if (!first_error) first_error = std::current_exception();
    }
  }
  if (first_error) std::rethrow_exception(first_error);
}

MaskWriter::MaskWriter(std::string folder) : folder_(std::move(folder)) {
  PrepareOutputFolder(folder_);
}

void MaskWriter::operator()(StampNs stamp_ns, const cv::Mat& mask) const {
  WriteImage(mask, folder_ + "/" + FormatStamp(stamp_ns) + ".png");
}

}  // namespace posefusion
