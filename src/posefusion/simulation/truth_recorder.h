#pragma once

#include <string>
#include <vector>

#include "posefusion/dataset/people_file.h"
#include "posefusion/simulation/events.h"
#include "posefusion/simulation/simulator.h"
#include "posefusion/simulation/truth_files.h"

namespace posefusion {

/// Collects the truth about a simulated run while its frames go by. Not thread-safe.
class TruthRecorder {
 public:
  /// Frames come in their order.
  void Add(const SimulatedFrame& frame, const Simulator& simulator);

  /// Writes everything that is known besides images and keypoints into a folder that exists:
  /// rgb.txt, depth.txt, camera.yaml, blur.txt, joints/, the files of truth_files.h and of
  /// robot_files.h. blur.txt: `stamp blur_px`, how far the image moves during the exposure, as the
  /// median over all of it (TrueBlurLength() in exposure.h).
  /// @throws std::runtime_error naming a file that cannot be written.
  void Write(const Simulator& simulator, const std::string& folder) const;

 private:
  std::string rgb_list_ = "# stamp file\n";
  std::string depth_list_ = "# stamp file\n";
  std::string blur_list_ = "# stamp blur_px\n";
  std::vector<PeopleAtStamp> people_;
  std::vector<JointsAtStamp> joints_;
  OcclusionRecorder occlusions_;
};

/// Where the images of a frame are in its folder.
std::string RgbFileName(const SimulatedFrame& frame);
std::string DepthFileName(const SimulatedFrame& frame);

}  // namespace posefusion
