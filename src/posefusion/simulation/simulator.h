#pragma once

#include <optional>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/rgbd_frame.h"
#include "posefusion/simulation/keypoints.h"
#include "posefusion/simulation/sensor.h"
#include "posefusion/simulation/simulation_config.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Stamp of time 0 of every run.
constexpr StampNs kSimulationStartNs = 1'000'000'000'000'000'000;
constexpr double kFrameRateHz = 30;
/// Units of depth PNGs per metre, as in the TUM RGB-D benchmark.
constexpr double kSimulatedDepthScale = 5000;

/// Stamp of a time since the start, rounded to microseconds so that texts hold it exactly.
StampNs SimulationStamp(double time_s);

/// Time since the start.
double SimulationTime(StampNs stamp_ns);

/// A frame as it is streamed and written, and the truth about it at the colour stamp.
struct SimulatedFrame {
  int index = 0;
  double time_s = 0;  ///< of the colour image, since the start
  RgbdFrame frame;    ///< rounded to what the PNGs of a folder hold
  cv::Mat labels;     ///< CV_8UC1, kLabel...
  cv::Mat true_depth_m;
  std::vector<TruePerson> people;  ///< those in view
  double blur_length_px = 0;
};

/// Renders a run frame by frame. The same configuration gives the same bytes for any number of
/// threads. Not thread-safe.
class Simulator {
 public:
  /// @throws std::invalid_argument as CheckedConfig does.
  Simulator(const SimulationConfig& config, int num_threads);

  /// The next frame; nothing after the last.
  std::optional<SimulatedFrame> Next();

  int NumFrames() const { return num_frames_; }
  const SimulationConfig& config() const { return config_; }
  const Mover& mover() const { return mover_; }
  const World& world() const { return world_; }
  const CameraModel& camera() const { return sensor_.camera(); }

 private:
  SimulationConfig config_;
  Mover mover_;
  World world_;
  Sensor sensor_;
  ParallelRunner runner_;
  int num_frames_;
  int next_ = 0;
};

/// What a pose network found in a frame and when it said so.
struct DetectedPeople {
  std::vector<Skeleton> people;
  StampNs arrival_ns = 0;  ///< the frame's stamp when on time
};

/// Keypoints of a frame by the fault model and timing of the run; empty for frames that the network
/// leaves out.
std::optional<DetectedPeople> DetectKeypoints(const SimulatedFrame& frame,
                                              const Simulator& simulator);

/// Depth as a PNG of the folder holds it: CV_16UC1 in units of 1 / kSimulatedDepthScale, 0 where
/// there is none or where it is beyond the largest number (13.1 m).
cv::Mat QuantizeDepth(const cv::Mat& depth_m);

}  // namespace posefusion
