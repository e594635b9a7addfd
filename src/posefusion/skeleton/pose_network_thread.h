#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "posefusion/skeleton/pose_network_config.h"
#include "posefusion/skeleton/skeletons.h"
#include "posefusion/skeleton/stamp_rate_limit.h"

namespace posefusion {

/// Finds people in an image (CV_8UC3, R G B), such as PoseNetwork::Detect.
using PeopleDetector = std::function<std::vector<Skeleton>(const cv::Mat& rgb)>;

/// Where the thread's results go; called on the thread, exceptions are reported to on_error.
struct PoseNetworkThreadHooks {
  std::function<void(const Skeletons&)> on_skeletons;  ///< also for images without people
  std::function<void(const std::string&)> on_error;    ///< one image failed; the thread goes on
};

/// Looks for people on a thread of its own, for cameras that do not wait: of the images offered
/// meanwhile the newest wins. Offer() may be called from any thread.
class PoseNetworkThread {
 public:
  /// Starts the thread, which from now on alone uses `detector`. Of `config` the rate_hz and the
  /// niceness count; other threads of OpenCV, if num_threads asks for them, keep their priority.
  /// @throws std::invalid_argument naming the key for a value out of range.
  PoseNetworkThread(PeopleDetector detector, const PoseNetworkConfig& config,
                    PoseNetworkThreadHooks hooks);

  /// Ends the thread after the image it is at.
  ~PoseNetworkThread();
  PoseNetworkThread(const PoseNetworkThread&) = delete;
  PoseNetworkThread& operator=(const PoseNetworkThread&) = delete;

  /// Never waits for the network. The image is shared and must not be changed afterwards.
  void Offer(StampNs stamp_ns, const cv::Mat& rgb);

 private:
  struct Image {
    StampNs stamp_ns = 0;
    cv::Mat rgb;
  };

  void Run();
  std::optional<Image> WaitForImage();
  void LookAt(const Image& image);
  void Report(const std::string& text) const;

  const PeopleDetector detector_;
  const PoseNetworkConfig config_;
  const PoseNetworkThreadHooks hooks_;

  std::mutex mutex_;  ///< guards the three below
  StampRateLimit rate_limit_;
  std::optional<Image> newest_;
  bool stopping_ = false;

  std::condition_variable changed_;
  std::thread thread_;  ///< last: starts when everything above exists
};

}  // namespace posefusion
