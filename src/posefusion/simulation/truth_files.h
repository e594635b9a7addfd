#pragma once

#include <string>
#include <vector>

#include "posefusion/dataset/people_file.h"
#include "posefusion/simulation/events.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {

/// Body parts of everybody present at the time of a frame.
PeopleAtStamp PeopleAt(const World& world, double time_s);

/// True joints that the camera sees at the stamp of a colour image.
struct JointsAtStamp {
  StampNs stamp_ns = 0;
  std::vector<Skeleton> people;
};

/// Writes them as a perfect pose network would, in the format of keypoints/: a file
/// joints/<stamp>.json in OpenPose's format for each frame, all confidences 1.
/// @throws std::runtime_error naming what cannot be written.
void WriteJoints(const std::vector<JointsAtStamp>& joints, const std::string& folder);

/// Writes what is known about the world into an existing folder:
///   world.ply              everything that is not moved during the run, map frame
///   moved_objects.txt      and moved_objects/, what is moved: see moved_objects_file.h
///   people_capsules.txt    see people_file.h
///   events.txt             falls and full occlusions; no pose is expected during them
///   camera.yaml            of all frames
/// @throws std::runtime_error naming a file that cannot be written.
void WriteWorldFiles(const Simulator& simulator, const std::vector<PeopleAtStamp>& people,
                     const std::vector<SimulationEvent>& occlusions, const std::string& folder);

/// simulation.yaml: what the folder was made from. Written last, it says that the folder is whole.
void WriteSimulationFile(const Simulator& simulator, const std::string& folder);

}  // namespace posefusion
