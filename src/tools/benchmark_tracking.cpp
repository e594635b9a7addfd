// What each choice of levels, strides and iterations costs and gives on a recorded sequence:
// residual rows a frame, nanoseconds a row (one thread), milliseconds a frame, ATE and RPE.
//
//   benchmark_tracking [FOLDER [MAX_FRAMES]] [--benchmark_...]     default: fr1_xyz, all frames

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "posefusion/common/package_files.h"
#include "posefusion/common/stage_clock.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/evaluation/trajectory_evaluation.h"
#include "posefusion/pipeline/slam.h"

namespace {

namespace pf = posefusion;

struct Sequence {
  std::vector<pf::RgbdFrame> frames;
  pf::Trajectory truth;
};

struct Choice {
  const char* name;
  std::function<void(pf::SlamConfig&)> apply;
};

const std::vector<Choice>& Choices() {
  static const std::vector<Choice> choices = {
      {"default", [](pf::SlamConfig&) {}},
      {"finest_level_0", [](pf::SlamConfig& c) { c.tracking.finest_level = 0; }},
      {"finest_level_0_view_level_0",
       [](pf::SlamConfig& c) { c.tracking.finest_level = c.splat.level = 0; }},
      {"finest_level_2", [](pf::SlamConfig& c) { c.tracking.finest_level = 2; }},
      {"finest_stride_2", [](pf::SlamConfig& c) { c.tracking.finest_stride_px = 2; }},
      {"finest_stride_3", [](pf::SlamConfig& c) { c.tracking.finest_stride_px = 3; }},
      {"coarsest_level_3", [](pf::SlamConfig& c) { c.tracking.coarsest_level = 3; }},
      {"iterations_5_4",
       [](pf::SlamConfig& c) {
         c.tracking.coarse_iterations = 5;
         c.tracking.finest_iterations = 4;
       }},
      {"no_early_stop",
       [](pf::SlamConfig& c) { c.tracking.min_step_m = c.tracking.min_step_rad = 0; }},
      {"no_so3", [](pf::SlamConfig& c) { c.tracking.so3.enabled = false; }},
      {"icp_only", [](pf::SlamConfig& c) { c.tracking.use_intensity = false; }},
      {"intensity_only", [](pf::SlamConfig& c) { c.tracking.use_icp = false; }},
      {"icp_weight_1", [](pf::SlamConfig& c) { c.tracking.icp_weight = 1; }},
      {"spawn_stride_1", [](pf::SlamConfig& c) { c.fusion.spawn_stride_px = 1; }},
  };
  return choices;
}

double TrackMs(const pf::FrameResult& result) {
  for (const pf::StageTime& time : result.stage_times) {
    if (std::string(time.stage) == "track") return time.milliseconds;
  }
  return 0;
}

void RunChoice(benchmark::State& state, const Choice& choice, const Sequence& sequence) {
  constexpr double kNanosecondsPerMillisecond = 1e6;
  pf::SlamConfig config;
  choice.apply(config);
  for (auto _ : state) {
    pf::Slam slam(config, 1);
    std::vector<double> track_ms;
    double total_ms = 0;
    double rows = 0;
    for (const pf::RgbdFrame& frame : sequence.frames) {
      const pf::FrameResult result = slam.ProcessFrame(frame);
      track_ms.push_back(TrackMs(result));
      total_ms += track_ms.back();
      rows += static_cast<double>(result.tracking.num_rows_total);
    }
    const auto evaluation = pf::EvaluateTrajectory(sequence.truth, slam.trajectory());
    const auto num_frames = static_cast<double>(sequence.frames.size());
    state.counters["rows"] = rows / num_frames;
    state.counters["ns_per_row"] = total_ms * kNanosecondsPerMillisecond / rows;
    state.counters["track_ms"] = pf::Quantile(track_ms, 0.5);
    state.counters["ATE_mm"] = 1000 * evaluation.absolute.translation_m.rmse;
    state.counters["RPE_mmps"] = 1000 * evaluation.relative.translation_mps.rmse;
    state.counters["lost"] = num_frames - static_cast<double>(slam.trajectory().size());
  }
}

Sequence LoadSequence(const std::string& folder, int max_frames) {
  pf::TumFolderOptions options;
  options.max_frames = max_frames;
  pf::TumFolderSource source(folder, options);
  Sequence sequence;
  while (auto frame = source.Next()) sequence.frames.push_back(*frame);
  sequence.truth = pf::ReadTrajectory(folder + "/groundtruth.txt");
  return sequence;
}

std::string DefaultFolder() {
  const char* data = std::getenv("POSEFUSION_DATA");
  const std::string root = data != nullptr ? data : pf::FindPackageFile("../shared/data");
  return root + "/fr1_xyz";
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  try {
    const auto sequence = std::make_unique<Sequence>(
        LoadSequence(argc > 1 ? argv[1] : DefaultFolder(), argc > 2 ? std::atoi(argv[2]) : 0));
    for (const Choice& choice : Choices()) {
      benchmark::RegisterBenchmark(choice.name,
                                   [&](benchmark::State& s) { RunChoice(s, choice, *sequence); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_tracking: %s\n", error.what());
    return 1;
  }
  return 0;
}
