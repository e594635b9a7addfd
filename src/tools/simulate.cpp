// Makes a data set: a camera on a humanoid or in a hand among people, with exact truth.

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "posefusion/simulation/folder_writer.h"
#include "posefusion/simulation/sim_keypoints.h"
#include "posefusion/simulation/simulator.h"
#include "posefusion_ros/simulation_bag.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/tool_main.h"

namespace {

namespace pf = posefusion;

struct Arguments {
  pf::SimulationConfig config;
  std::string out;
  std::string bag;
  int num_threads = 2;
  bool force = false;
};

std::string PresetHelp() {
  std::string text = "one of";
  for (const pf::SimulationPreset& preset : pf::SimulationPresets()) {
    text += "\n  " + preset.name + ": " + preset.what;
  }
  return text;
}

void AddOptions(CLI::App& app, Arguments& arguments) {
  pf::SimulationConfig& config = arguments.config;
  app.add_option("--preset", config.preset, PresetHelp())->required();
  app.add_option("--out", arguments.out, "folder to make, TUM format with truth")->required();
  app.add_option("--humans", config.humans, "people, 0 to 6")->capture_default_str();
  app.add_option("--seed", config.seed, "of everything random")->capture_default_str();
  app.add_option("--seconds", config.seconds, "duration (default: as long as the preset takes)")
      ->check(CLI::Range(pf::kMinSimulationSeconds, pf::kMaxSimulationSeconds));
  app.add_option("--keypoint-rate", config.keypoint_timing.rate_hz,
                 "keypoints per second (default: every frame)")
      ->check(CLI::Range(0.1, 30.0));
  app.add_option("--keypoint-delay", config.keypoint_timing.latency_s,
                 "seconds from an image to its keypoints")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--bag", arguments.bag, "also write a rosbag; replaced if it exists");
  app.add_option("--threads", arguments.num_threads, "threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_flag("--force", arguments.force, "replace an earlier run in the folder");
}

/// False when it was interrupted; then nothing is left.
bool Simulate(const Arguments& arguments) {
  pf::FolderWriter folder(arguments.out, arguments.force);
  pf::Simulator simulator(arguments.config, arguments.num_threads);
  std::unique_ptr<pf::SimulationBag> bag;
  if (!arguments.bag.empty()) {
    bag = std::make_unique<pf::SimulationBag>(
        arguments.bag, pf::RecordRobot(simulator.config(), simulator.mover()));
  }
  pf::Progress progress("simulate", simulator.NumFrames());
  while (const auto frame = simulator.Next()) {
    if (pf::interrupted) return false;
    folder.Write(*frame, simulator);
    if (bag) bag->Write(frame->frame, pf::KeypointsAsWritten(*frame, simulator));
    progress.Update(frame->index + 1);
  }
  progress.Finish();
  if (bag) bag->Close();
  folder.Close(simulator);
  std::printf("%d frames of %s in %s\n", simulator.NumFrames(), simulator.config().preset.c_str(),
              arguments.out.c_str());
  return true;
}

int Run(Arguments& arguments) {
  try {
    arguments.config = pf::CheckedConfig(arguments.config);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simulate: --%s\n", error.what());
    return pf::kExitUsage;
  }
  pf::CatchInterrupts();
  if (Simulate(arguments)) return 0;
  std::fprintf(stderr, "simulate: interrupted; nothing has been written\n");
  return pf::kExitFailure;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Simulates an RGB-D camera among people and writes what it sees, with exact truth.");
  Arguments arguments;
  AddOptions(app, arguments);
  return posefusion::RunTool(app, argc, argv, "simulate", [&] { return Run(arguments); });
}
