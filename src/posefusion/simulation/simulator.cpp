#include "posefusion/simulation/simulator.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "posefusion/image/depth_units.h"

namespace posefusion {
namespace {

constexpr StampNs kNanosecondsPerMicrosecond = 1000;
constexpr double kMicrosecondsPerSecond = 1e6;

// OpenNI drivers without hardware synchronisation deliver depth some milliseconds apart from
// colour, with a slow beat because the two clocks are not equal.
constexpr double kDepthDelayS = 0.004;
constexpr double kDepthDelaySwingS = 0.003;
constexpr double kDepthDelayPeriodS = 11;
constexpr double kTwoPi = 6.283185307179586;

double DepthTime(double color_time_s) {
  return color_time_s + kDepthDelayS +
         kDepthDelaySwingS * std::sin(kTwoPi * color_time_s / kDepthDelayPeriodS);
}

}  // namespace

StampNs SimulationStamp(double time_s) {
  return kSimulationStartNs +
         std::llround(time_s * kMicrosecondsPerSecond) * kNanosecondsPerMicrosecond;
}

double SimulationTime(StampNs stamp_ns) { return SecondsBetween(kSimulationStartNs, stamp_ns); }

Simulator::Simulator(const SimulationConfig& config, int num_threads)
    : config_(CheckedConfig(config)),
      mover_(MakeMover(config_)),
      world_(MakeWorldConfig(config_, mover_)),
      sensor_(config_.sensor, world_),
      runner_(num_threads),
      num_frames_(static_cast<int>(std::floor(config_.seconds * kFrameRateHz + 1e-6))) {}

std::optional<SimulatedFrame> Simulator::Next() {
  if (next_ == num_frames_) return std::nullopt;
  SimulatedFrame result;
  result.index = next_++;
  const StampNs stamp_ns = SimulationStamp(result.index / kFrameRateHz);
  result.time_s = SimulationTime(stamp_ns);
  const StampNs depth_stamp_ns = SimulationStamp(DepthTime(result.time_s));
  SensorFrame captured = sensor_.Capture(*mover_.head, result.time_s,
                                         SimulationTime(depth_stamp_ns), result.index, runner_);
  result.frame = std::move(captured.frame);
  result.frame.index = result.index;
  result.frame.stamp_ns = stamp_ns;
  result.frame.depth_stamp_ns = depth_stamp_ns;
  result.frame.depth_m =
      DepthToMetres(QuantizeDepth(result.frame.depth_m), "simulator", kSimulatedDepthScale);
  result.labels = captured.labels;
  result.true_depth_m = captured.true_depth_m;
  result.blur_length_px = captured.blur_length_px;
  result.people = ProjectPeople(world_, camera(), mover_.head->T_map_camera(result.time_s),
                                result.time_s, result.labels);
  return result;
}

std::optional<DetectedPeople> DetectKeypoints(const SimulatedFrame& frame,
                                              const Simulator& simulator) {
  const SimulationConfig& config = simulator.config();
  const auto arrival_s =
      KeypointArrival(config.keypoint_timing, frame.time_s, 1 / kFrameRateHz, config.seed);
  if (!arrival_s) return std::nullopt;
  return DetectedPeople{DetectPeople(frame.people, config.keypoint_faults, simulator.camera(),
                                     frame.time_s, config.seed),
                        SimulationStamp(*arrival_s)};
}

cv::Mat QuantizeDepth(const cv::Mat& depth_m) {
  constexpr auto kScale = static_cast<float>(kSimulatedDepthScale);
  constexpr float kMax = std::numeric_limits<std::uint16_t>::max();
  cv::Mat raw(depth_m.size(), CV_16UC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto* metres = depth_m.ptr<float>(v);
    auto* units = raw.ptr<std::uint16_t>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      const float value = metres[u] * kScale;
      const bool usable = value > 0 && value <= kMax;
      // Half up by hand: std::lround is a call for every pixel.
      units[u] = static_cast<std::uint16_t>(usable ? static_cast<int>(value + 0.5F) : 0);
    }
  }
  return raw;
}

}  // namespace posefusion
