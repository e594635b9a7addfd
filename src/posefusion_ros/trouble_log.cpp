#include "posefusion_ros/trouble_log.h"

#include <chrono>
#include <utility>

namespace posefusion {

TroubleLog::TroubleLog(double period_s, Sink error, Sink info)
    : period_s_(period_s), error_(std::move(error)), info_(std::move(info)) {}

void TroubleLog::Report(const std::string& text, double now_s) {
  ++num_reports_;
  if (num_reports_ > 1 && text == last_text_ && now_s - last_line_s_ < period_s_) return;
  last_text_ = text;
  last_line_s_ = now_s;
  error_(num_reports_ == 1 ? text : text + " (" + std::to_string(num_reports_) + " so far)");
}

void TroubleLog::AllWell() {
  if (num_reports_ == 0) return;
  info_("back to normal after " + std::to_string(num_reports_) +
        " bad ones, the last: " + last_text_);
  num_reports_ = 0;
  last_text_.clear();
}

double SteadyNowS() {
  using Seconds = std::chrono::duration<double>;
  return std::chrono::duration_cast<Seconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace posefusion
