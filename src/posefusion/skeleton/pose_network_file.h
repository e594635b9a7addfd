#pragma once

#include <opencv2/dnn.hpp>

#include "posefusion/skeleton/pose_network_config.h"

namespace posefusion {

/// How a network wants its images: (value - mean) * scale.
struct ImagePreparation {
  double scale = 1;
  cv::Scalar mean;
  bool takes_bgr = false;  ///< false: R G B
};

/// Of a caffe network (OpenPose) when model_config is set, of tf-openpose otherwise.
ImagePreparation PreparationOf(const PoseNetworkConfig& config);

/// Reads the network's files. @throws std::invalid_argument naming the key (model, model_config),
/// the path, and what is wrong with a file.
cv::dnn::Net LoadPoseNetwork(const PoseNetworkConfig& config);

}  // namespace posefusion
