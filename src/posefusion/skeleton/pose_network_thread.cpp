#include "posefusion/skeleton/pose_network_thread.h"

#include <sys/resource.h>

#include <exception>
#include <utility>

#include "posefusion/common/stamp.h"

namespace posefusion {
namespace {

/// On Linux a thread has a niceness of its own, unlike in POSIX (man setpriority).
void LowerOwnPriority(int niceness) {
  constexpr id_t kCallingThread = 0;
  setpriority(PRIO_PROCESS, kCallingThread, niceness);  // if refused: runs at the old priority
}

}  // namespace

PoseNetworkThread::PoseNetworkThread(PeopleDetector detector, const PoseNetworkConfig& config,
                                     PoseNetworkThreadHooks hooks)
    : detector_(std::move(detector)),
      config_(CheckedConfig(config)),
      hooks_(std::move(hooks)),
      rate_limit_(config_.rate_hz),
      thread_([this] { Run(); }) {}

PoseNetworkThread::~PoseNetworkThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void PoseNetworkThread::Offer(StampNs stamp_ns, const cv::Mat& rgb) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!rate_limit_.Accept(stamp_ns)) return;
    newest_ = Image{stamp_ns, rgb};
  }
  changed_.notify_one();
}

void PoseNetworkThread::Run() {
  if (config_.niceness > 0) LowerOwnPriority(config_.niceness);
  while (const std::optional<Image> image = WaitForImage()) LookAt(*image);
}

std::optional<PoseNetworkThread::Image> PoseNetworkThread::WaitForImage() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return stopping_ || newest_; });
  if (stopping_) return std::nullopt;
  return std::exchange(newest_, std::nullopt);
}

void PoseNetworkThread::LookAt(const Image& image) {
  try {
    Skeletons skeletons;
    skeletons.stamp_ns = image.stamp_ns;
    skeletons.people = detector_(image.rgb);
    if (hooks_.on_skeletons) hooks_.on_skeletons(skeletons);
  } catch (const std::exception& error) {
    Report("image " + FormatStamp(image.stamp_ns) + ": " + error.what());
  } catch (...) {
    Report("image " + FormatStamp(image.stamp_ns) + ": unknown error");
  }
}

void PoseNetworkThread::Report(const std::string& text) const {
  try {
    if (hooks_.on_error) hooks_.on_error(text);
  } catch (...) {  // nobody is left to tell; the next image may do better
  }
}

}  // namespace posefusion
