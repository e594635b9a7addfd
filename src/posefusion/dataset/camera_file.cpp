#include "posefusion/dataset/camera_file.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "posefusion/config/config.h"

namespace posefusion {
namespace {

const std::set<std::string> kKeys = {"width", "height", "fx",         "fy",
                                     "cx",    "cy",     "distortion", "depth_scale"};

[[noreturn]] void ThrowFor(const std::string& path, const std::string& message) {
  throw std::invalid_argument(path + ": " + message);
}

template <class Number>
Number ReadNumber(const YAML::Node& node, const std::string& path, const std::string& key) {
  if (!node.IsDefined()) ThrowFor(path, "key '" + key + "' is missing");
  try {
    return node.as<Number>();
  } catch (const YAML::Exception&) {
    ThrowFor(path, "key '" + key + "': expected a number, got '" + YAML::Dump(node) + "'");
  }
}

void ReadDistortion(const YAML::Node& node, const std::string& path, CameraModel& camera) {
  if (!node.IsDefined()) return;
  if (!node.IsSequence() || node.size() > camera.distortion.size()) {
    ThrowFor(path, "key 'distortion': expected a list of at most five numbers k1 k2 p1 p2 k3");
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    camera.distortion[i] = ReadNumber<double>(node[i], path, "distortion");
  }
}

}  // namespace

CameraFile ReadCameraFile(const std::string& path) {
  const YAML::Node node = LoadYamlFile(path);
  if (!node.IsMap()) ThrowFor(path, "expected a map of keys");
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (kKeys.count(key) == 0) ThrowFor(path, "unknown key '" + key + "'");
  }
  CameraFile file;
  file.camera.width = ReadNumber<int>(node["width"], path, "width");
  file.camera.height = ReadNumber<int>(node["height"], path, "height");
  file.camera.fx = ReadNumber<double>(node["fx"], path, "fx");
  file.camera.fy = ReadNumber<double>(node["fy"], path, "fy");
  file.camera.cx = ReadNumber<double>(node["cx"], path, "cx");
  file.camera.cy = ReadNumber<double>(node["cy"], path, "cy");
  ReadDistortion(node["distortion"], path, file.camera);
  file.depth_scale = ReadNumber<double>(node["depth_scale"], path, "depth_scale");
  file.camera.Check(path);
  if (!(file.depth_scale > 0 && std::isfinite(file.depth_scale))) {
    ThrowFor(path, "key 'depth_scale' is not positive");
  }
  return file;
}

}  // namespace posefusion
