#include "posefusion/simulation/simulation_config.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "posefusion/config/config.h"
#include "posefusion/simulation/handheld_motion.h"

namespace posefusion {
namespace {

constexpr const char* kScheme = "sim:";
constexpr int kMaxHumans = 6;
constexpr int kMaxSeed = 1'000'000;
constexpr double kFirstFallS = 6;
constexpr double kWayIntervalS = 1;

template <class Number>
void CheckRange(const char* name, Number value, Number min, Number max) {
  if (value >= min && value <= max) return;
  std::ostringstream message;
  message << name << ": " << value << " is outside [" << min << ", " << max << "]";
  throw std::invalid_argument(message.str());
}

double ParseNumber(const std::string& key, const std::string& text, bool whole) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool usable = !text.empty() && *end == '\0' && std::isfinite(value) &&
                      (!whole || (value == std::floor(value) && std::abs(value) <= 1e9));
  if (usable) return value;
  throw std::invalid_argument(key + ": '" + text + "' is not a " + (whole ? "whole " : "") +
                              "number");
}

void SetOption(const std::string& option, SimulationConfig& config) {
  const std::size_t equals = option.find('=');
  const std::string key = option.substr(0, equals);
  const std::string text = equals == std::string::npos ? "" : option.substr(equals + 1);
  if (key == "humans") {
    config.humans = static_cast<int>(ParseNumber(key, text, true));
  } else if (key == "seed") {
    config.seed = static_cast<int>(ParseNumber(key, text, true));
  } else if (key == "seconds") {
    config.seconds = ParseNumber(key, text, false);
    CheckRange("seconds", config.seconds, kMinSimulationSeconds, kMaxSimulationSeconds);
  } else {
    throw std::invalid_argument("'" + key + "' is none of humans, seed, seconds");
  }
}

std::shared_ptr<const RobotMotion> MakeRobot(const SimulationConfig& config) {
  const SimulationPreset& preset = FindPreset(config.preset);
  WalkPlanConfig plan;
  plan.seed = config.seed;
  plan.seconds = config.seconds;
  if (config.preset == "hrp_falls") plan.first_fall_s = kFirstFallS;
  const Route route = config.preset == "corridor"   ? LongRoute()
                      : config.preset == "hrp_room" ? WallRoute(config.seed)
                                                    : TableRoute(config.seed);
  return std::make_shared<RobotMotion>(route, FloorObstacles(preset.room), plan);
}

std::optional<HandheldKind> HandheldKindOf(const std::string& preset) {
  if (preset == "fr3_static") return HandheldKind::kStatic;
  if (preset == "fr3_xyz") return HandheldKind::kXyz;
  if (preset == "fr3_rpy") return HandheldKind::kRpy;
  if (preset == "fr3_halfsphere") return HandheldKind::kHalfsphere;
  return std::nullopt;
}

}  // namespace

const std::vector<SimulationPreset>& SimulationPresets() {
  static const std::vector<SimulationPreset> presets = {
      {"hrp_loop", "a humanoid walks around table and chairs", RoomKind::kLab, 60},
      {"hrp_room", "a humanoid walks along the walls", RoomKind::kLab, 100},
      {"hrp_falls", "a humanoid walks around the table and falls", RoomKind::kLab, 45},
      {"fr3_static", "hand-held, still", RoomKind::kLab, 30},
      {"fr3_xyz", "hand-held, along the axes", RoomKind::kLab, 30},
      {"fr3_rpy", "hand-held, about the axes", RoomKind::kLab, 30},
      {"fr3_halfsphere", "hand-held, on a half sphere", RoomKind::kLab, 30},
      {"corridor", "a humanoid walks through rooms and corridor and back", RoomKind::kCorridor,
       412},
  };
  return presets;
}

const SimulationPreset& FindPreset(const std::string& name) {
  std::string names;
  for (const SimulationPreset& preset : SimulationPresets()) {
    if (preset.name == name) return preset;
    names += " " + preset.name;
  }
  throw std::invalid_argument("preset: '" + name + "' is none of" + names);
}

SimulationConfig CheckedConfig(const SimulationConfig& config) {
  SimulationConfig checked = config;
  const SimulationPreset& preset = FindPreset(config.preset);
  if (checked.seconds == 0) checked.seconds = preset.seconds;
  CheckRange("humans", checked.humans, 0, kMaxHumans);
  CheckRange("seed", checked.seed, 0, kMaxSeed);
  CheckRange("seconds", checked.seconds, kMinSimulationSeconds, kMaxSimulationSeconds);
  CheckRanges("keypoint_faults", checked.keypoint_faults);
  CheckRanges("keypoint_timing", checked.keypoint_timing);
  checked.sensor.seed = checked.seed;
  return checked;
}

std::optional<SimulationConfig> ParseSimulationName(const std::string& text) {
  if (text.rfind(kScheme, 0) != 0) return std::nullopt;
  const std::string rest = text.substr(std::string(kScheme).size());
  const std::size_t question = rest.find('?');
  SimulationConfig config;
  config.preset = rest.substr(0, question);
  try {
    std::istringstream options(question == std::string::npos ? "" : rest.substr(question + 1));
    for (std::string option; std::getline(options, option, '&');) SetOption(option, config);
    return CheckedConfig(config);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(text + ": " + error.what());
  }
}

Mover MakeMover(const SimulationConfig& config) {
  if (const auto kind = HandheldKindOf(config.preset)) {
    return {std::make_shared<HandheldMotion>(*kind, config.seed, config.seconds), nullptr};
  }
  const auto robot = MakeRobot(config);
  return {robot, robot};
}

WorldConfig MakeWorldConfig(const SimulationConfig& config, const Mover& mover) {
  WorldConfig world;
  world.room = FindPreset(config.preset).room;
  world.humans = config.humans;
  world.seed = config.seed;
  world.seconds = config.seconds;
  world.head = mover.head;
  for (double t = 0; t <= config.seconds; t += kWayIntervalS) {
    world.keep_clear.emplace_back(mover.head->T_map_camera(t).translation().head<2>());
  }
  if (!mover.robot) return world;
  for (const Fall& fall : mover.robot->falls()) {
    if (fall.view != FallView::kPasserBy) continue;
    world.visits.push_back({fall.impact_s(), fall.raise_s()});
  }
  return world;
}

}  // namespace posefusion
