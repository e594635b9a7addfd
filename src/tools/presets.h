#pragma once

#include <string>
#include <vector>

namespace posefusion {

/// Names of the files in config/presets, without their ending, in alphabetical order.
std::vector<std::string> PresetNames();

/// The path of a preset's yaml file.
std::string PresetFile(const std::string& name);

}  // namespace posefusion
