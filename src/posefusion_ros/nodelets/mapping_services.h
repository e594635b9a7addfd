#pragma once

#include <posefusion/SaveFile.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>

#include "posefusion_ros/nodelets/mapping_worker.h"

namespace posefusion {

/// What people can ask of Mapping while it runs: reset, pause, save_ply, save_trajectory. Answers
/// say what was done or why not; nothing that is asked stops the mapping.
class MappingServices {
 public:
  /// `private_node` must have a callback queue of its own, because answers wait for the worker.
  /// `output_dir`: the only folder where files are written; "" = none are. `worker` must outlive
  /// this.
  MappingServices(ros::NodeHandle private_node, std::string output_dir, MappingWorker& worker);

 private:
  using Trigger = std_srvs::Trigger;
  using SetBool = std_srvs::SetBool;

  bool Reset(Trigger::Request& request, Trigger::Response& response);
  bool Pause(SetBool::Request& request, SetBool::Response& response);
  bool SavePly(SaveFile::Request& request, SaveFile::Response& response);
  bool SaveTrajectory(SaveFile::Request& request, SaveFile::Response& response);

  const std::string output_dir_;
  MappingWorker& worker_;
  ros::ServiceServer reset_;
  ros::ServiceServer pause_;
  ros::ServiceServer save_ply_;
  ros::ServiceServer save_trajectory_;
};

}  // namespace posefusion
