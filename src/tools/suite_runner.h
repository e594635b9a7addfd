#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/suite_figures.h"

namespace posefusion {

struct SuiteOptions {
  std::string out;
  int num_parallel = 1;
  double ms_per_frame = 60;                     ///< first guess of a frame's time in run_dataset
  std::function<bool()> should_stop;            ///< asked from several threads
  std::function<void(const std::string&)> say;  ///< told about progress, one call at a time
};

/// Runs the jobs that have not been done yet, several at a time, and gives the outcomes of all in
/// their order. Only one suite may use the output folder at a time.
/// @throws std::runtime_error naming a folder that cannot be used.
std::vector<JobOutcome> RunSuite(const std::vector<SuiteJob>& jobs, const SuitePrograms& programs,
                                 const SuiteOptions& options);

}  // namespace posefusion
