#include "posefusion_ros/pace_meter.h"

#include <algorithm>
#include <vector>

#include "posefusion/common/stage_clock.h"

namespace posefusion {

double PaceMeter::RateHz(double now_s) {
  DropOld(now_s);
  if (notes_.size() < 2) return static_cast<double>(notes_.size()) / window_s_;
  const double seconds = std::min(window_s_, std::max(now_s - *start_s_, 1e-3));
  return static_cast<double>(notes_.size()) / seconds;
}

double PaceMeter::DelayQuantileS(double share) const {
  if (notes_.empty()) return 0;
  std::vector<double> delays;
  delays.reserve(notes_.size());
  for (const Entry& entry : notes_) delays.push_back(entry.delay_s);
  return Quantile(std::move(delays), share);
}

}  // namespace posefusion
