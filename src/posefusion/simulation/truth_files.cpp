#include "posefusion/simulation/truth_files.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/config/config.h"
#include "posefusion/dataset/mesh_file.h"
#include "posefusion/simulation/robot_record.h"
#include "posefusion/simulation/true_meshes.h"
#include "posefusion/skeleton/openpose_json.h"

namespace posefusion {
namespace {

std::string CameraText(const CameraModel& camera) {
  std::array<char, 400> text{};
  const auto& d = camera.distortion;
  std::snprintf(text.data(), text.size(),
                "width: %d\nheight: %d\nfx: %.9g\nfy: %.9g\ncx: %.9g\ncy: %.9g\n"
                "distortion: [%.9g, %.9g, %.9g, %.9g, %.9g]\ndepth_scale: %.9g\n",
                camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, d[0], d[1],
                d[2], d[3], d[4], kSimulatedDepthScale);
  return text.data();
}

/// The same with numbers of at most 12 digits: 0.06 for 0.059999999999999998.
YAML::Node Shortened(const YAML::Node& node) {
  if (node.IsMap()) {
    YAML::Node map;
    for (const auto& entry : node) map[entry.first.as<std::string>()] = Shortened(entry.second);
    return map;
  }
  double number = 0;
  if (!YAML::convert<double>::decode(node, number)) return node;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.12g", number);
  return YAML::Node(std::string(text.data()));
}

}  // namespace

PeopleAtStamp PeopleAt(const World& world, double time_s) {
  PeopleAtStamp moment;
  moment.stamp_ns = SimulationStamp(time_s);
  for (int person = 0; person < world.num_people(); ++person) {
    const PersonPose pose = world.PersonAt(person, time_s);
    if (!pose.present) continue;
    for (int part = 0; part < kNumBodyParts; ++part) {
      const Capsule& capsule = pose.capsules[static_cast<std::size_t>(part)];
      moment.capsules.push_back({person, part, capsule.from.cast<float>(), capsule.to.cast<float>(),
                                 static_cast<float>(capsule.radius_m)});
    }
  }
  return moment;
}

void WriteJoints(const std::vector<JointsAtStamp>& joints, const std::string& folder) {
  const std::string own = folder + "/joints";
  std::error_code error;
  std::filesystem::create_directories(own, error);
  if (error) throw std::runtime_error(own + ": cannot be made: " + error.message());
  for (const JointsAtStamp& now : joints) {
    WriteFileAtomically(own + "/" + FormatStamp(now.stamp_ns) + ".json",
                        ToOpenPoseJson(now.people));
  }
}

void WriteWorldFiles(const Simulator& simulator, const std::vector<PeopleAtStamp>& people,
                     const std::vector<SimulationEvent>& occlusions, const std::string& folder) {
  WriteMesh(UnmovedSurfaces(simulator.world()), folder + "/world.ply");
  WriteMovedObjects(MovedSurfacesOf(simulator.world()), folder);
  WritePeople(people, folder + "/people_capsules.txt");
  std::vector<SimulationEvent> events = occlusions;
  if (simulator.mover().robot) {
    const auto falls = FallEvents(simulator.mover().robot->falls());
    events.insert(events.end(), falls.begin(), falls.end());
  }
  WriteFileAtomically(folder + "/events.txt", FormatEvents(events));
  WriteFileAtomically(folder + "/camera.yaml", CameraText(simulator.camera()));
}

void WriteSimulationFile(const Simulator& simulator, const std::string& folder) {
  const SimulationConfig& config = simulator.config();
  YAML::Node node;
  node["preset"] = config.preset;
  node["humans"] = config.humans;
  node["seed"] = config.seed;
  node["seconds"] = config.seconds;
  node["frames"] = simulator.NumFrames();
  node["imu_frame"] = simulator.mover().robot ? kRootLink : kCameraLink;
  node["keypoint_faults"] = Shortened(ToYaml(config.keypoint_faults));
  node["keypoint_timing"] = Shortened(ToYaml(config.keypoint_timing));
  node["sensor"] = Shortened(ToYaml(config.sensor));
  node["version"] = POSEFUSION_VERSION;
  WriteFileAtomically(folder + "/simulation.yaml", YAML::Dump(node) + "\n");
}

}  // namespace posefusion
