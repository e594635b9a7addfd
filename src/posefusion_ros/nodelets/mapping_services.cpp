#include "posefusion_ros/nodelets/mapping_services.h"

#include <exception>
#include <stdexcept>
#include <utility>

#include "posefusion/common/confined_path.h"
#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"

namespace posefusion {
namespace {

/// Fills success and message of an answer by what `act` returns or throws.
template <class Response, class Act>
bool Answer(Response& response, const Act& act) {
  try {
    response.message = act();
    response.success = 1;
  } catch (const std::exception& error) {
    response.message = error.what();
    response.success = 0;
  }
  return true;  // false would hide the message
}

void RunBetween(MappingWorker& worker, const std::function<void(Slam&)>& step) {
  if (!worker.Between(step)) throw std::runtime_error("the mapping is too busy or ends");
}

std::string FileFor(const std::string& output_dir, const SaveFile::Request& request) {
  if (output_dir.empty()) {
    throw std::invalid_argument("ros/output_dir is empty: there is no folder to write into");
  }
  return ConfinedPath(output_dir, request.name, request.overwrite != 0);
}

}  // namespace

MappingServices::MappingServices(ros::NodeHandle private_node, std::string output_dir,
                                 MappingWorker& worker)
    : output_dir_(std::move(output_dir)),
      worker_(worker),
      reset_(private_node.advertiseService("reset", &MappingServices::Reset, this)),
      pause_(private_node.advertiseService("pause", &MappingServices::Pause, this)),
      save_ply_(private_node.advertiseService("save_ply", &MappingServices::SavePly, this)),
      save_trajectory_(private_node.advertiseService("save_trajectory",
                                                     &MappingServices::SaveTrajectory, this)) {}

bool MappingServices::Reset(Trigger::Request&, Trigger::Response& response) {
  return Answer(response, [&] {
    std::size_t num_surfels = 0;
    RunBetween(worker_, [&](Slam& slam) {
      num_surfels = slam.NumSurfels();
      worker_.Reset();
    });
    return "map of " + std::to_string(num_surfels) + " surfels and all poses forgotten";
  });
}

bool MappingServices::Pause(SetBool::Request& request, SetBool::Response& response) {
  return Answer(response, [&]() -> std::string {
    const bool pause = request.data != 0;
    if (worker_.SetPaused(pause) == pause) return pause ? "was paused already" : "was not paused";
    return pause ? "paused: frames are thrown away" : "goes on from the last pose";
  });
}

bool MappingServices::SavePly(SaveFile::Request& request, SaveFile::Response& response) {
  return Answer(response, [&] {
    const std::string path = FileFor(output_dir_, request);
    SurfelCloud cloud;
    RunBetween(worker_,
               [&](Slam& slam) { cloud = slam.ExportMap(slam.config().export_min_confidence); });
    if (cloud.size() == 0) throw std::runtime_error("the map is empty: nothing is written");
    WritePly(cloud, path);
    return path + ": " + std::to_string(cloud.size()) + " surfels";
  });
}

bool MappingServices::SaveTrajectory(SaveFile::Request& request, SaveFile::Response& response) {
  return Answer(response, [&] {
    const std::string path = FileFor(output_dir_, request);
    Trajectory trajectory;
    RunBetween(worker_, [&](Slam& slam) { trajectory = slam.trajectory(); });
    if (trajectory.empty()) throw std::runtime_error("there is no pose yet: nothing is written");
    WriteTrajectory(trajectory, path);
    return path + ": " + std::to_string(trajectory.size()) + " poses";
  });
}

}  // namespace posefusion
