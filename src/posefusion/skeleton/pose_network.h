#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/skeleton/pose_network_config.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Finds the joints of people in colour images with a pose network of the OpenPose family that
/// gives 19 heat maps (18 COCO joints, background) and 38 part affinity fields, on the CPU through
/// OpenCV. The same image gives the same joints whatever the number of threads. Not thread-safe.
class PoseNetwork {
 public:
  /// Loads the network and runs it once.
  /// @throws std::invalid_argument naming the key and the path for a file that is missing, of
  /// another kind or of a network with other outputs, for an input size that the network does not
  /// take, and for values out of range.
  explicit PoseNetwork(const PoseNetworkConfig& config);
  ~PoseNetwork();
  PoseNetwork(PoseNetwork&&) noexcept;
  PoseNetwork& operator=(PoseNetwork&&) noexcept;

  /// People in an image (CV_8UC3, R G B), joints in its pixels; the most certain first, kMaxPeople
  /// at most. @throws std::invalid_argument for an empty image or another type, and
  /// std::runtime_error when OpenCV fails.
  std::vector<Skeleton> Detect(const cv::Mat& rgb);

  const PoseNetworkConfig& config() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace posefusion
