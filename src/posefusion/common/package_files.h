#pragma once

#include <string>

namespace posefusion {

/// A file or folder that ships with the package ("config/presets", "scripts/plot_trajectory.py"):
/// beside the running program where it is installed (<prefix>/share/posefusion), else in the source
/// tree that it was built from. Empty when in neither.
std::string FindPackageFile(const std::string& relative_path);

}  // namespace posefusion
