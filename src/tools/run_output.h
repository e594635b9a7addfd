#pragma once

#include <string>

#include "posefusion/pipeline/offline_run.h"

namespace posefusion {

/// Makes the folder and proves that it can be written to.
/// @throws std::runtime_error naming the folder and the system's reason.
void PrepareOutputFolder(const std::string& folder);

/// Writes trajectory.txt, trajectory_live.txt, frames.txt, map.ply and report.json. Every file that
/// can be written is written. `odometry` names where odometry came from, "none" for none.
/// @throws std::runtime_error naming the first that could not.
void WriteRunOutput(const OfflineRun& run, const SystemConfig& config, const std::string& odometry,
                    const std::string& folder);

/// report.json as text.
std::string ReportJson(const OfflineRun& run, const SystemConfig& config,
                       const std::string& odometry);

/// Writes person masks (CV_8UC1) as <stamp>.png into `folder`, which is made.
/// @throws std::runtime_error naming what cannot be written, at once or when called.
class MaskWriter {
 public:
  explicit MaskWriter(std::string folder);
  void operator()(StampNs stamp_ns, const cv::Mat& mask) const;

 private:
  std::string folder_;
};

}  // namespace posefusion
