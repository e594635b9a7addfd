// Time of cutting two people out of a simulated frame, 640x480, one thread.

#include <benchmark/benchmark.h>

#include "posefusion/segmentation/person_cutter.h"
#include "posefusion/simulation/simulator.h"

namespace {

namespace pf = posefusion;

struct Input {
  pf::RgbdFrame frame;
  pf::Skeletons skeletons;
};

const Input& FirstFrame() {
  static const Input input = [] {
    pf::SimulationConfig config;
    config.preset = "fr3_xyz";
    config.seconds = 1;
    pf::Simulator simulator(pf::CheckedConfig(config), 2);
    const auto frame = simulator.Next();
    pf::Skeletons skeletons;
    skeletons.people = pf::PerfectKeypoints(frame->people);
    return Input{frame->frame, skeletons};
  }();
  return input;
}

void Cut(benchmark::State& state, pf::MinCutBackend backend) {
  const Input& input = FirstFrame();
  pf::HumanRemovalConfig config;
  config.min_cut.backend = backend;
  pf::PersonCutter cutter(config);
  cv::Mat mask;
  for (auto _ : state) cutter.Cut(input.frame, input.skeletons, mask);
  state.counters["people"] = static_cast<double>(input.skeletons.people.size());
}

BENCHMARK_CAPTURE(Cut, grid, pf::MinCutBackend::kGrid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Cut, pcl, pf::MinCutBackend::kPcl)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
