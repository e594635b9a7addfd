#pragma once

#include <string>

#include "posefusion/pipeline/slam.h"

namespace posefusion {

/// Makes the folder when it is missing and proves that files can be written into it.
/// @throws std::invalid_argument naming `key` and the folder when not.
void CheckOutputDir(const std::string& output_dir, const std::string& key);

/// Writes trajectory.txt and map.ply; each file is replaced at once.
/// @throws std::runtime_error naming the file that could not be written.
void SaveResults(const Slam& slam, const std::string& output_dir);

}  // namespace posefusion
