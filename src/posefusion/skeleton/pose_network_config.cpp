#include "posefusion/skeleton/pose_network_config.h"

#include <stdexcept>
#include <string>

#include "posefusion/config/config.h"

namespace posefusion {
namespace {

void CheckMultipleOf8(const std::string& key, int value) {
  if (value % 8 == 0) return;
  throw std::invalid_argument("pose_network." + key + " is " + std::to_string(value) +
                              "; it has to be a multiple of 8");
}

}  // namespace

PoseNetworkConfig CheckedConfig(const PoseNetworkConfig& config) {
  CheckRanges("pose_network", config);
  CheckMultipleOf8("input_width_px", config.input_width_px);
  CheckMultipleOf8("input_height_px", config.input_height_px);
  return config;
}

}  // namespace posefusion
