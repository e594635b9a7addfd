#include "run_inputs.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/simulation/robot_record.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "posefusion_ros/bag_odometry.h"
#include "posefusion_ros/bag_skeletons.h"
#include "posefusion_ros/bag_source.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

constexpr char kNone[] = "none";
constexpr char kTopicPrefix[] = "topic:";
constexpr char kTfPrefix[] = "tf:";

/// Leaves out frames of another source before `start_s` and after `max_frames`.
class TrimmedSource : public FrameSource {
 public:
  TrimmedSource(std::unique_ptr<FrameSource> source, double start_s, int max_frames)
      : source_(std::move(source)), start_s_(start_s), max_frames_(max_frames) {}

  std::optional<RgbdFrame> Next() override {
    if (max_frames_ > 0 && num_given_ >= max_frames_) return std::nullopt;
    while (auto frame = source_->Next()) {
      if (!first_stamp_ns_) first_stamp_ns_ = frame->stamp_ns;
      if (SecondsBetween(*first_stamp_ns_, frame->stamp_ns) < start_s_) continue;
      ++num_given_;
      return frame;
    }
    return std::nullopt;
  }

  std::optional<int> NumFrames() const override {
    const auto all = source_->NumFrames();
    if (max_frames_ == 0 || !all) return all;
    return std::min(*all, max_frames_);
  }

 private:
  std::unique_ptr<FrameSource> source_;
  double start_s_;
  int max_frames_;
  int num_given_ = 0;
  std::optional<StampNs> first_stamp_ns_;
};

bool IsBag(const std::string& source) {
  return std::filesystem::path(source).extension() == ".bag";
}

/// What stands behind a prefix; nothing without it.
/// @throws std::invalid_argument when the source is no bag.
std::optional<std::string> InBag(const std::string& text, const std::string& prefix,
                                 const std::string& source) {
  if (text.rfind(prefix, 0) != 0) return std::nullopt;
  if (!IsBag(source)) throw std::invalid_argument(text + ": " + source + " is no bag");
  return text.substr(prefix.size());
}

/// What comes with the frames beside them.
struct Source {
  std::unique_ptr<FrameSource> frames;
  std::shared_ptr<const SimulatedRun> simulation;  ///< null for recorded frames
  std::unique_ptr<SkeletonSource> keypoints;       ///< null = none
};

Source OpenBagFrames(const RunInputNames& names, const CameraInfoConfig& camera_info) {
  BagSourceOptions options;
  options.images_are_rectified = camera_info.images_are_rectified;
  Source source;
  source.frames = std::make_unique<TrimmedSource>(
      std::make_unique<BagSource>(names.source, options), names.start_s, names.max_frames);
  if (names.keypoints.empty() && HasSkeletons(names.source, kSkeletonsInTopic)) {
    source.keypoints = std::make_unique<BagSkeletons>(names.source, kSkeletonsInTopic);
  }
  return source;
}

Source OpenSimulation(const RunInputNames& names, const SimulationConfig& config) {
  Source source;
  auto frames = std::make_unique<SimSource>(config, names.num_threads);
  source.simulation = frames->run();
  if (names.keypoints.empty()) source.keypoints = frames->MakeKeypoints();
  source.frames =
      std::make_unique<TrimmedSource>(std::move(frames), names.start_s, names.max_frames);
  return source;
}

Source OpenFolder(const RunInputNames& names) {
  TumFolderOptions options;
  options.start_s = names.start_s;
  options.max_frames = names.max_frames;
  Source source;
  source.frames = std::make_unique<TumFolderSource>(names.source, options);
  const std::string folder = names.source + "/keypoints";
  if (names.keypoints.empty() && std::filesystem::is_directory(folder)) {
    source.keypoints = std::make_unique<SkeletonFolder>(folder);
  }
  return source;
}

Source OpenSource(const RunInputNames& names, const CameraInfoConfig& camera_info) {
  if (IsBag(names.source)) return OpenBagFrames(names, camera_info);
  if (const auto simulation = ParseSimulationName(names.source)) {
    return OpenSimulation(names, *simulation);
  }
  return OpenFolder(names);
}

/// The keypoints that are asked for, as fast and as late as they are asked for; null for none.
std::unique_ptr<SkeletonSource> OpenKeypoints(const RunInputNames& names,
                                              std::unique_ptr<SkeletonSource> own) {
  if (names.keypoints == kNone) return nullptr;
  std::unique_ptr<SkeletonSource> keypoints = std::move(own);
  if (const auto topic = InBag(names.keypoints, kTopicPrefix, names.source)) {
    keypoints = std::make_unique<BagSkeletons>(names.source, *topic);
  } else if (!names.keypoints.empty()) {
    keypoints = std::make_unique<SkeletonFolder>(names.keypoints);
  }
  if (!keypoints) return nullptr;
  return std::make_unique<TimedSkeletons>(std::move(keypoints), names.delivery);
}

std::unique_ptr<OdometrySource> ReadOdometry(const std::string& path) {
  return std::make_unique<RecordedOdometry>(ReadTrajectory(path));
}

void OpenOwnOdometry(const RunInputNames& names, RunInputs& inputs) {
  const std::string path = names.source + "/odometry_camera.txt";
  if (inputs.simulation) {
    const Simulator& simulator = inputs.simulation->simulator;
    Trajectory trajectory = CameraOdometry(RecordRobot(simulator.config(), simulator.mover()));
    if (trajectory.empty()) return;
    inputs.odometry = std::make_unique<RecordedOdometry>(std::move(trajectory));
    inputs.odometry_name = "simulator";
  } else if (std::filesystem::exists(path)) {
    inputs.odometry = ReadOdometry(path);
    inputs.odometry_name = path;
  }
}

/// Tracking uses its motion, human removal its upward direction.
bool UsesOdometry(const SystemConfig& config, const RunInputs& inputs) {
  const bool removes_people = config.human_removal.enabled && inputs.keypoints != nullptr;
  return config.mapping.tracking.prior.enabled || removes_people;
}

void OpenOdometry(const RunInputNames& names, bool uses_odometry, RunInputs& inputs) {
  inputs.odometry_name = kNone;
  if (names.odometry == kNone) return;
  if (names.odometry.empty()) {
    if (uses_odometry) OpenOwnOdometry(names, inputs);
    return;
  }
  if (!uses_odometry) {
    throw std::invalid_argument("--odometry " + names.odometry +
                                ": nobody would use it: mapping.tracking.prior.enabled is false, "
                                "and no people are removed");
  }
  const auto frame = InBag(names.odometry, kTfPrefix, names.source);
  if (frame) {
    inputs.odometry = std::make_unique<BagOdometry>(names.source, *frame, kCameraRgbTopic);
  } else {
    inputs.odometry = ReadOdometry(names.odometry);
  }
  inputs.odometry_name = names.odometry;
}

}  // namespace

RunInputs OpenRunInputs(const RunInputNames& names, const SystemConfig& config) {
  Source source = OpenSource(names, config.camera_info);
  RunInputs inputs;
  inputs.frames = std::move(source.frames);
  inputs.simulation = std::move(source.simulation);
  inputs.keypoints = OpenKeypoints(names, std::move(source.keypoints));
  OpenOdometry(names, UsesOdometry(config, inputs), inputs);
  return inputs;
}

}  // namespace posefusion
