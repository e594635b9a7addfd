#include "tools/suite_runner.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "tools/progress.h"
#include "tools/run_output.h"
#include "tools/suite_time.h"

namespace posefusion {
namespace {

/// Keeps other suites out of the output folder.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder) {
    const std::string path = folder + "/.lock";
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    if (file_ >= 0) close(file_);
    throw std::runtime_error(
        folder + ": " +
        (error == EWOULDBLOCK ? "another suite is writing here" : std::strerror(error)));
  }
  ~FolderLock() { close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

/// Shares the jobs out to threads.
class Runner {
 public:
  Runner(const std::vector<SuiteJob>& jobs, const SuitePrograms& programs,
         const SuiteOptions& options)
      : programs_(programs), options_(options), time_(options.ms_per_frame, options.num_parallel) {
    for (const SuiteJob& job : jobs) outcomes_.push_back({job, JobResult(), Figures()});
  }

  std::vector<JobOutcome> Run() {
    FindWhatIsDone();
    options_.say(EstimateText());
    std::vector<std::thread> threads;
    for (int i = 0; i < options_.num_parallel; ++i) threads.emplace_back([this] { Work(); });
    for (std::thread& thread : threads) thread.join();
    for (JobOutcome& outcome : outcomes_) AddFigures(outcome);
    return std::move(outcomes_);
  }

 private:
  void FindWhatIsDone() {
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
      JobOutcome& outcome = outcomes_[i];
      const auto record = FindRecord(outcome.job, JobFolder(options_.out, outcome.job), programs_);
      if (record) {
        outcome.result = {JobState::kDone, *record, ""};
        time_.AddDone(outcome.job, record->wall_s, /*was_pending=*/false);
        ++num_done_;
      } else {
        time_.AddPending(outcome.job);
        pending_.push_back(i);
      }
    }
  }

  std::string EstimateText() const {
    std::string text = std::to_string(outcomes_.size()) + " jobs, " + std::to_string(num_done_) +
                       " already done; about " + DurationText(time_.RemainingS()) + " for the rest";
    const auto num_unknown = std::count_if(pending_.begin(), pending_.end(), [&](std::size_t i) {
      return !NumFrames(outcomes_[i].job).has_value();
    });
    if (num_unknown > 0) text += " (" + std::to_string(num_unknown) + " of unknown length)";
    return text;
  }

  /// The next job to do; null when there is none or no more are wanted.
  JobOutcome* Take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (next_ == pending_.size() || options_.should_stop()) return nullptr;
    JobOutcome* outcome = &outcomes_[pending_[next_++]];
    options_.say("started " + outcome->job.id);
    return outcome;
  }

  void Work() {
    while (JobOutcome* outcome = Take()) {
      const std::string folder = JobFolder(options_.out, outcome->job);
      outcome->result = RunJob(outcome->job, folder, programs_, options_.should_stop);
      const std::lock_guard<std::mutex> lock(mutex_);
      Account(*outcome);
    }
  }

  void Account(const JobOutcome& outcome) {
    const JobResult& result = outcome.result;
    if (result.state == JobState::kStopped) return options_.say("stopped " + outcome.job.id);
    ++num_done_;
    std::string text = "[" + std::to_string(num_done_) + "/" + std::to_string(outcomes_.size()) +
                       "] " + outcome.job.id + ": ";
    if (result.state == JobState::kDone) {
      time_.AddDone(outcome.job, result.record.wall_s, /*was_pending=*/true);
      text += "done in " + DurationText(result.record.wall_s);
    } else {
      time_.Drop(outcome.job);
      text += "FAILED: " + result.problem;
    }
    options_.say(text + "; about " + DurationText(time_.RemainingS()) + " left");
  }

  void AddFigures(JobOutcome& outcome) const {
    if (outcome.result.state == JobState::kStopped) return;
    try {
      outcome.figures = ReadFigures(JobFolder(options_.out, outcome.job));
    } catch (const std::exception& error) {
      outcome.result.state = JobState::kFailed;
      if (outcome.result.problem.empty()) outcome.result.problem = error.what();
    }
  }

  const SuitePrograms& programs_;
  const SuiteOptions& options_;
  std::vector<JobOutcome> outcomes_;
  std::vector<std::size_t> pending_;  ///< indices of outcomes_
  std::mutex mutex_;                  ///< guards what follows, and `say`
  std::size_t next_ = 0;              ///< of pending_
  SuiteTime time_;
  int num_done_ = 0;
};

}  // namespace

std::vector<JobOutcome> RunSuite(const std::vector<SuiteJob>& jobs, const SuitePrograms& programs,
                                 const SuiteOptions& options) {
  PrepareOutputFolder(options.out);
  const FolderLock lock(options.out);
  return Runner(jobs, programs, options).Run();
}

}  // namespace posefusion
