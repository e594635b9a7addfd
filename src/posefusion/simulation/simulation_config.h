#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "posefusion/simulation/head_motion.h"
#include "posefusion/simulation/keypoints.h"
#include "posefusion/simulation/robot_motion.h"
#include "posefusion/simulation/sensor_config.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Shortest and longest run.
constexpr double kMinSimulationSeconds = 0.1;
constexpr double kMaxSimulationSeconds = 3600;

/// Which run is simulated. Equal values give equal bytes.
struct SimulationConfig {
  std::string preset;
  int humans = 2;
  int seed = 1;
  double seconds = 0;  ///< 0 = as long as the preset takes
  SensorConfig sensor;
  KeypointFaultConfig keypoint_faults;
  KeypointTiming keypoint_timing;
};

/// One way of moving the camera through one of the rooms.
struct SimulationPreset {
  std::string name;
  std::string what;  ///< a phrase for lists
  RoomKind room = RoomKind::kLab;
  double seconds = 30;
};

const std::vector<SimulationPreset>& SimulationPresets();

/// @throws std::invalid_argument naming the preset and those that there are.
const SimulationPreset& FindPreset(const std::string& name);

/// The same with `seconds` filled in. @throws std::invalid_argument for an unknown preset and for
/// humans, seed or seconds out of range.
SimulationConfig CheckedConfig(const SimulationConfig& config);

/// Reads `sim:PRESET?humans=N&seed=N&seconds=S`; everything after the preset may be left out and
/// then has the default. Empty when `text` does not begin with "sim:".
/// @throws std::invalid_argument naming the part that cannot be used.
std::optional<SimulationConfig> ParseSimulationName(const std::string& text);

/// Camera of a run and, where a robot carries it, the robot: then both are the same object.
struct Mover {
  std::shared_ptr<const HeadMotion> head;
  std::shared_ptr<const RobotMotion> robot;  ///< null for a hand-held camera
};

Mover MakeMover(const SimulationConfig& checked_config);

/// Rooms and people of the run around that camera.
WorldConfig MakeWorldConfig(const SimulationConfig& checked_config, const Mover& mover);

}  // namespace posefusion
