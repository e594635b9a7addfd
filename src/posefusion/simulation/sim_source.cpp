#include "posefusion/simulation/sim_source.h"

#include <utility>

namespace posefusion {

SimSource::SimSource(const SimulationConfig& config, int num_threads,
                     std::function<void(const SimulatedFrame&)> on_frame)
    : simulator_(config, num_threads), on_frame_(std::move(on_frame)) {}

std::optional<RgbdFrame> SimSource::Next() {
  auto frame = simulator_.Next();
  if (!frame) return std::nullopt;
  if (on_frame_) on_frame_(*frame);
  return std::move(frame->frame);
}

}  // namespace posefusion
