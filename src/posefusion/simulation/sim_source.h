#pragma once

#include <functional>
#include <memory>

#include "posefusion/dataset/frame_source.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {

/// Streams a simulated run: the same frames, byte for byte, as TumFolderSource reads from the
/// folder that the tool `simulate` writes for the same arguments.
class SimSource : public FrameSource {
 public:
  /// `on_frame`, when given, sees each frame with its truth before Next returns it, on the thread
  /// that calls Next. @throws std::invalid_argument as CheckedConfig does.
  SimSource(const SimulationConfig& config, int num_threads,
            std::function<void(const SimulatedFrame&)> on_frame = nullptr);

  std::optional<RgbdFrame> Next() override;
  std::optional<int> NumFrames() const override { return simulator_.NumFrames(); }

  const Simulator& simulator() const { return simulator_; }

 private:
  Simulator simulator_;
  std::function<void(const SimulatedFrame&)> on_frame_;
};

}  // namespace posefusion
