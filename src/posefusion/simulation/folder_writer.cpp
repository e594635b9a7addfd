#include "posefusion/simulation/folder_writer.h"

#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/simulation/truth_files.h"
#include "posefusion/skeleton/openpose_json.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "simulation.yaml";
constexpr int kWaitingFrames = 4;

[[noreturn]] void Refuse(const std::string& folder, const std::string& why) {
  throw std::runtime_error(folder + ": " + why);
}

/// @throws naming why the folder must not be written to.
void CheckFolder(const std::string& folder, bool force) {
  std::error_code error;
  if (!fs::exists(folder, error) && !error) return;
  if (error) Refuse(folder, "cannot be used: " + error.message());
  if (!fs::is_directory(folder)) Refuse(folder, "is no folder");
  if (fs::is_empty(folder)) return;
  const bool is_simulation = fs::exists(folder + "/" + kMark);
  if (!force) Refuse(folder, "is not empty (--force replaces a simulated run)");
  if (!is_simulation) Refuse(folder, "holds something else than a simulated run, which stays");
}

std::string WithoutSlash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

/// The name of the folder goes over to the finished one; an earlier run goes away after that.
void Rename(const std::string& from, const std::string& to) {
  const std::string old = to + ".old";
  fs::remove_all(old);
  const bool replaces = fs::exists(to);
  if (replaces) fs::rename(to, old);
  fs::rename(from, to);
  fs::remove_all(old);
}

}  // namespace

FolderWriter::FolderWriter(const std::string& folder, bool force)
    : folder_(WithoutSlash(folder)), partial_(folder_ + ".partial") {
  if (folder_.empty()) throw std::runtime_error("the output folder has no name");
  CheckFolder(folder_, force);
  try {
    fs::remove_all(partial_);
    for (const char* name : {"rgb", "depth", "labels", "keypoints"}) {
      fs::create_directories(PathOf(name));
    }
  } catch (const fs::filesystem_error& error) {
    Refuse(folder_, "cannot be made: " + error.code().message());
  }
  images_ = std::make_unique<TaskThread>(kWaitingFrames);
}

FolderWriter::~FolderWriter() {
  images_.reset();  // before the folder that it writes into goes away
  if (complete_) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void FolderWriter::Write(const SimulatedFrame& frame, const Simulator& simulator) {
  images_->Add([this, frame] { WriteImages(frame); });
  WriteKeypoints(frame, simulator);
  truth_.Add(frame, simulator);
}

void FolderWriter::WriteImages(const SimulatedFrame& frame) const {
  cv::Mat bgr;
  cv::cvtColor(frame.frame.rgb, bgr, cv::COLOR_RGB2BGR);
  WriteImage(bgr, PathOf(RgbFileName(frame)));
  WriteImage(QuantizeDepth(frame.frame.depth_m), PathOf(DepthFileName(frame)));
  WriteImage(frame.labels, PathOf("labels/" + FormatStamp(frame.frame.stamp_ns) + ".png"));
}

void FolderWriter::WriteKeypoints(const SimulatedFrame& frame, const Simulator& simulator) {
  const auto detected = DetectKeypoints(frame, simulator);
  if (!detected) return;
  const std::string stamp = FormatStamp(frame.frame.stamp_ns);
  WriteFileAtomically(PathOf("keypoints/" + stamp + ".json"), ToOpenPoseJson(detected->people));
  if (detected->arrival_ns == frame.frame.stamp_ns) return;
  arrivals_ += stamp + " " + FormatStamp(detected->arrival_ns) + "\n";
}

void FolderWriter::Close(const Simulator& simulator) {
  images_->Finish();
  if (simulator.config().keypoint_timing.latency_s > 0) {
    WriteFileAtomically(PathOf("keypoints/arrival.txt"), arrivals_);
  }
  truth_.Write(simulator, partial_);
  WriteSimulationFile(simulator, partial_);
  try {
    Rename(partial_, folder_);
  } catch (const fs::filesystem_error& error) {
    Refuse(folder_, "cannot be replaced: " + error.code().message());
  }
  complete_ = true;
}

}  // namespace posefusion
