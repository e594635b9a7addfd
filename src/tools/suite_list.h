#pragma once

#include <string>
#include <vector>

namespace posefusion {

/// The list of evaluate_suite:
///
///   runs:
///     - name: xyz                       # unique
///       sources: ["sim:fr3_xyz?humans=2&seed={seed}&seconds=20"]
///       presets: [default, ef]          # names of config/presets; default: none of them
///       seeds: [1, 2, 3]                # default: [1]
///       options: [--threads, "2"]       # more arguments for run_dataset; default: none
///       truth: "/data/xyz/{seed}"       # folder with groundtruth.txt and, for the map, world.ply;
///                                       # default: the source if it is a folder with
///                                       # groundtruth.txt, otherwise {out}/truth if that is there
///       exclude: "{truth}/events.txt"   # intervals that do not count; default: that file if it is
///                                       # there; "none" for none
///       frames: 600                     # only for the estimate of time, where nothing else tells
///
/// Every source runs with every preset and every seed. {seed}, {source}, {out} (the job's folder)
/// and {truth} are replaced in sources, options, truth and exclude as far as they are known there.
/// Paths are relative to the working folder.

/// One run of run_dataset and its evaluation.
struct SuiteJob {
  std::string name;             ///< of the list's entry
  std::string source_template;  ///< as the list has it
  std::string preset;           ///< "default" for none
  int seed = 1;
  std::string id;  ///< path of the job's folder below the output folder, unique
  std::string source;
  std::vector<std::string> options;
  std::string truth;    ///< may hold {out}; empty: not given
  std::string exclude;  ///< may hold {out} and {truth}; empty: not given
  int frames = 0;       ///< 0: not given
};

constexpr char kDefaultPreset[] = "default";

/// Reads a list and makes its jobs, in its order (source, preset, seed).
/// @throws std::invalid_argument naming the file and the key or value that cannot be used.
std::vector<SuiteJob> ReadSuite(const std::string& path, const std::vector<std::string>& presets);

/// `text` with every "{name}" replaced.
std::string Substituted(std::string text, const std::string& name, const std::string& value);

}  // namespace posefusion
