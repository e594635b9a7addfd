#pragma once

#include <memory>
#include <string>

#include "posefusion/dataset/frame_source.h"
#include "posefusion/dataset/odometry_source.h"
#include "posefusion/pipeline/system_config.h"
#include "posefusion/simulation/sim_source.h"
#include "posefusion/skeleton/skeleton_source.h"
#include "posefusion/skeleton/timed_skeletons.h"

namespace posefusion {

/// What run_dataset is to read, in the words of its options.
struct RunInputNames {
  std::string source;     ///< folder in TUM format, .bag, or "sim:PRESET?..."
  std::string keypoints;  ///< folder, "topic:NAME" of a bag or "none"; empty = what the source has
  std::string odometry;   ///< file, "tf:FRAME" of a bag or "none"; empty = what the source has
  KeypointDelivery delivery;
  int max_frames = 0;  ///< 0 = all
  int num_threads = 2;
  double start_s = 0;  ///< so much is left out at the beginning
};

struct RunInputs {
  std::unique_ptr<FrameSource> frames;
  std::unique_ptr<SkeletonSource> keypoints;       ///< null = none
  std::unique_ptr<OdometrySource> odometry;        ///< null = none
  std::string odometry_name;                       ///< for the report
  std::shared_ptr<const SimulatedRun> simulation;  ///< null for recorded frames
};

/// Odometry of the source itself stays closed where `config` has no use for it.
/// @throws std::invalid_argument when odometry is named that would not be used, std::runtime_error
/// naming the file, topic or frame that cannot be had.
RunInputs OpenRunInputs(const RunInputNames& names, const SystemConfig& config);

}  // namespace posefusion
