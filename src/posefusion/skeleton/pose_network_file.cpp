#include "posefusion/skeleton/pose_network_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace posefusion {
namespace {

[[noreturn]] void Refuse(const std::string& key, const std::string& path, const std::string& why) {
  throw std::invalid_argument("pose_network." + key + ": " + path + (path.empty() ? "" : " ") +
                              why);
}

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void CheckReadable(const std::string& key, const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) Refuse(key, path, "does not exist");
  if (!std::filesystem::is_regular_file(path, error)) Refuse(key, path, "is no file");
  if (!std::ifstream(path)) Refuse(key, path, "cannot be read");
}

void CheckFiles(const PoseNetworkConfig& config) {
  if (config.model.empty()) Refuse("model", "", "is empty; a network's file is needed");
  CheckReadable("model", config.model);
  if (!config.model_config.empty()) {
    CheckReadable("model_config", config.model_config);
  } else if (EndsWith(config.model, ".caffemodel")) {
    Refuse("model_config", "", "is empty; the .prototxt of " + config.model + " is needed");
  }
}

cv::dnn::Net Read(const PoseNetworkConfig& config) {
  if (config.model_config.empty()) return cv::dnn::readNetFromTensorflow(config.model);
  try {
    cv::dnn::readNetFromCaffe(config.model_config);
  } catch (const cv::Exception& error) {
    Refuse("model_config", config.model_config, "is no caffe network description: " + error.err);
  }
  return cv::dnn::readNetFromCaffe(config.model_config, config.model);
}

}  // namespace

ImagePreparation PreparationOf(const PoseNetworkConfig& config) {
  constexpr double kMiddle = 127.5;
  if (config.model_config.empty()) return {1 / kMiddle, cv::Scalar::all(kMiddle), false};
  return {1.0 / 255, cv::Scalar::all(0), true};
}

cv::dnn::Net LoadPoseNetwork(const PoseNetworkConfig& config) {
  CheckFiles(config);
  const std::string kind = config.model_config.empty() ? "TensorFlow graph" : "caffe model";
  cv::dnn::Net net;
  try {
    net = Read(config);
  } catch (const cv::Exception& error) {
    Refuse("model", config.model, "is no " + kind + " that OpenCV can read: " + error.err);
  }
  if (net.empty()) Refuse("model", config.model, "is no " + kind + ": it has no layers");
  net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  return net;
}

}  // namespace posefusion
