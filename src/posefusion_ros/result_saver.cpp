#include "posefusion_ros/result_saver.h"

#include <filesystem>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"

namespace posefusion {

namespace fs = std::filesystem;

void CheckOutputDir(const std::string& output_dir, const std::string& key) {
  try {
    fs::create_directories(output_dir);
    const std::string probe = (fs::path(output_dir) / ".posefusion_write_test").string();
    WriteFileAtomically(probe, "");
    fs::remove(probe);
  } catch (const std::exception& error) {
    throw std::invalid_argument(key + ": cannot write into '" + output_dir + "': " + error.what());
  }
}

void SaveResults(const Slam& slam, const std::string& output_dir) {
  const fs::path folder(output_dir);
  WriteTrajectory(slam.trajectory(), (folder / "trajectory.txt").string());
  WritePly(slam.ExportMap(slam.config().export_min_confidence), (folder / "map.ply").string());
}

}  // namespace posefusion
