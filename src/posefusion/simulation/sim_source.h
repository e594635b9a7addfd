#pragma once

#include <memory>

#include "posefusion/dataset/frame_source.h"
#include "posefusion/simulation/sim_keypoints.h"
#include "posefusion/simulation/simulator.h"
#include "posefusion/simulation/truth_recorder.h"

namespace posefusion {

/// A simulated run and the truth about those of its frames that have been given out.
struct SimulatedRun {
  Simulator simulator;
  TruthRecorder truth;

  /// Writes what TruthRecorder holds into `folder`, which is made.
  /// @throws std::runtime_error naming what cannot be written.
  void WriteTruth(const std::string& folder) const;
};

/// Streams a simulated run: the same frames, byte for byte, as TumFolderSource reads from the
/// folder that the tool `simulate` writes for the same arguments.
class SimSource : public FrameSource {
 public:
  /// @throws std::invalid_argument as CheckedConfig does.
  SimSource(const SimulationConfig& config, int num_threads);

  std::optional<RgbdFrame> Next() override;
  std::optional<int> NumFrames() const override { return run_->simulator.NumFrames(); }

  /// To be looked at when nobody calls Next any more; lives on when the source does not.
  std::shared_ptr<const SimulatedRun> run() const { return run_; }

  /// Keypoints of the frames that Next gives out from now on, the same ones as in the folder. May
  /// be used in another thread than this source. To be called once, before the first frame.
  std::unique_ptr<SkeletonSource> MakeKeypoints();

 private:
  std::shared_ptr<SimulatedRun> run_;
  std::shared_ptr<KeypointMailbox> mailbox_;  ///< null while nobody wants keypoints
};

}  // namespace posefusion
