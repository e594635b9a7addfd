#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/suite_list.h"

namespace posefusion {

/// The programs that a job runs.
class SuitePrograms {
 public:
  /// @throws std::runtime_error naming one that is not in the folder.
  explicit SuitePrograms(const std::string& folder);

  const std::string& run_dataset() const { return paths_[0]; }
  const std::string& evaluate_trajectory() const { return paths_[1]; }
  const std::string& evaluate_map() const { return paths_[2]; }
  const std::string& evaluate_blur() const { return paths_[3]; }
  const std::string& evaluate_masks() const { return paths_[4]; }

  /// Says which programs these are: a hash of their bytes.
  std::uint64_t fingerprint() const { return fingerprint_; }

 private:
  std::vector<std::string> paths_;
  std::uint64_t fingerprint_ = 0;
};

/// What a finished job says of itself.
struct JobRecord {
  double wall_s = 0;  ///< of all its programs
};

enum class JobState {
  kDone,
  kFailed,
  kStopped,  ///< interrupted or not started
};

const char* ToString(JobState state);

struct JobResult {
  JobState state = JobState::kStopped;
  JobRecord record;
  std::string problem;  ///< why it failed, with the log file's name
};

/// Where a job writes to: report.json, evaluation.json, live/evaluation.json, map_evaluation.json,
/// mask_evaluation.json, blur_evaluation.json, log.txt and, when all is done, done.json.
std::string JobFolder(const std::string& out, const SuiteJob& job);

/// The record of a job that has been done with the same commands, files and programs; nothing
/// otherwise. What a source holds is not looked at.
std::optional<JobRecord> FindRecord(const SuiteJob& job, const std::string& folder,
                                    const SuitePrograms& programs);

/// Runs a job in an emptied folder: run_dataset, then evaluate_trajectory for the final and the
/// live poses, evaluate_map, evaluate_masks and evaluate_blur, as far as there is a truth. Masks
/// are there when the options have --masks. Never throws for what goes wrong in the job.
JobResult RunJob(const SuiteJob& job, const std::string& folder, const SuitePrograms& programs,
                 const std::function<bool()>& should_stop);

}  // namespace posefusion
