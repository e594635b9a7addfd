#include "posefusion/simulation/truth_recorder.h"

#include <array>
#include <cstdio>

#include "posefusion/common/atomic_file.h"
#include "posefusion/simulation/robot_files.h"

namespace posefusion {

std::string RgbFileName(const SimulatedFrame& frame) {
  return "rgb/" + FormatStamp(frame.frame.stamp_ns) + ".png";
}

std::string DepthFileName(const SimulatedFrame& frame) {
  return "depth/" + FormatStamp(frame.frame.depth_stamp_ns) + ".png";
}

void TruthRecorder::Add(const SimulatedFrame& frame, const Simulator& simulator) {
  const std::string stamp = FormatStamp(frame.frame.stamp_ns);
  rgb_list_ += stamp + " " + RgbFileName(frame) + "\n";
  depth_list_ += FormatStamp(frame.frame.depth_stamp_ns) + " " + DepthFileName(frame) + "\n";
  std::array<char, 32> blur{};
  std::snprintf(blur.data(), blur.size(), " %.3f\n", frame.blur_length_px);
  blur_list_ += stamp + blur.data();
  people_.push_back(PeopleAt(simulator.world(), frame.time_s));
  joints_.push_back({frame.frame.stamp_ns, PerfectKeypoints(frame.people)});
  occlusions_.Add(frame.frame.stamp_ns, StaticShare(frame.labels));
}

void TruthRecorder::Write(const Simulator& simulator, const std::string& folder) const {
  WriteFileAtomically(folder + "/rgb.txt", rgb_list_);
  WriteFileAtomically(folder + "/depth.txt", depth_list_);
  WriteFileAtomically(folder + "/blur.txt", blur_list_);
  WriteRobotFiles(RecordRobot(simulator.config(), simulator.mover()), folder);
  WriteJoints(joints_, folder);
  WriteWorldFiles(simulator, people_, occlusions_.events(), folder);
}

}  // namespace posefusion
