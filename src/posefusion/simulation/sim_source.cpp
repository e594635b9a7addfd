#include "posefusion/simulation/sim_source.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace posefusion {

void SimulatedRun::WriteTruth(const std::string& folder) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be made: " + error.message());
  truth.Write(simulator, folder);
}

SimSource::SimSource(const SimulationConfig& config, int num_threads)
    : run_(new SimulatedRun{Simulator(config, num_threads), {}}) {}

std::optional<RgbdFrame> SimSource::Next() {
  auto frame = run_->simulator.Next();
  if (!frame) return std::nullopt;
  run_->truth.Add(*frame, run_->simulator);
  if (mailbox_) {
    if (auto keypoints = KeypointsAsWritten(*frame, run_->simulator)) {
      mailbox_->Put(std::move(*keypoints));
    }
  }
  return std::move(frame->frame);
}

std::unique_ptr<SkeletonSource> SimSource::MakeKeypoints() {
  mailbox_ = std::make_shared<KeypointMailbox>();
  return std::make_unique<SimKeypoints>(mailbox_);
}

}  // namespace posefusion
