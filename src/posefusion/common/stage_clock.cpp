#include "posefusion/common/stage_clock.h"

#include <algorithm>
#include <cmath>

namespace posefusion {

StageClock::Scope::Scope(StageClock& clock, const char* stage)
    : clock_(clock), stage_(stage), start_(std::chrono::steady_clock::now()) {}

StageClock::Scope::~Scope() {
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start_;
  clock_.times_.push_back({stage_, elapsed.count()});
}

double Quantile(std::vector<double> samples, double q) {
  if (samples.empty()) return 0;
  const auto last = static_cast<double>(samples.size()) - 1;
  const auto rank = static_cast<std::ptrdiff_t>(std::lround(q * last));
  std::nth_element(samples.begin(), samples.begin() + rank, samples.end());
  return samples[static_cast<std::size_t>(rank)];
}

}  // namespace posefusion
