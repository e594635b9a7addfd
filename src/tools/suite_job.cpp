#include "tools/suite_job.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/child_process.h"
#include "tools/presets.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

constexpr char kStampFile[] = "done.json";
constexpr char kLogFile[] = "log.txt";
constexpr char kNoExclude[] = "none";

/// Fowler-Noll-Vo hash (FNV-1a, 64 bit).
class Hash {
 public:
  void Add(const std::string& bytes) {
    for (const char c : bytes) AddByte(static_cast<unsigned char>(c));
    AddByte(0);
  }
  std::uint64_t value() const { return value_; }

 private:
  void AddByte(unsigned char byte) { value_ = (value_ ^ byte) * 1099511628211U; }

  std::uint64_t value_ = 14695981039346656037U;
};

Command RunCommand(const SuiteJob& job, const std::string& folder, const SuitePrograms& programs) {
  Command command = {programs.run_dataset(), job.source, "--out", folder};
  if (job.preset != kDefaultPreset) command.insert(command.end(), {"--preset", job.preset});
  for (const std::string& option : job.options) {
    command.push_back(Substituted(option, "out", folder));
  }
  return command;
}

/// A text that differs whenever the job's outcome may.
std::string StampText(const SuiteJob& job, const std::string& folder,
                      const SuitePrograms& programs) {
  const Command command = RunCommand(job, folder, programs);
  Hash files;
  if (job.preset != kDefaultPreset) files.Add(ReadWholeFile(PresetFile(job.preset)));
  for (const std::string& option : job.options) {
    if (fs::is_regular_file(option)) files.Add(ReadWholeFile(option));
  }
  const nlohmann::json stamp = {{"command", command},     {"truth", job.truth},
                                {"exclude", job.exclude}, {"programs", programs.fingerprint()},
                                {"files", files.value()}, {"version", POSEFUSION_VERSION}};
  return stamp.dump();
}

/// The folder of the truth; empty when there is none.
/// @throws std::runtime_error when the list names one that has no groundtruth.txt.
std::string TruthFolder(const SuiteJob& job, const std::string& folder) {
  const auto has_poses = [](const fs::path& truth) {
    return fs::exists(truth / "groundtruth.txt");
  };
  if (!job.truth.empty()) {
    const std::string truth = Substituted(job.truth, "out", folder);
    if (!has_poses(truth)) throw std::runtime_error(truth + ": has no groundtruth.txt");
    return truth;
  }
  for (const std::string& truth : {job.source, folder + "/truth"}) {
    if (has_poses(truth)) return truth;
  }
  return "";
}

std::string ExcludeFile(const SuiteJob& job, const std::string& folder, const std::string& truth) {
  if (job.exclude == kNoExclude) return "";
  if (job.exclude.empty()) return fs::exists(truth + "/events.txt") ? truth + "/events.txt" : "";
  return Substituted(Substituted(job.exclude, "out", folder), "truth", truth);
}

bool HasTrueMasks(const std::string& truth) {
  return fs::is_directory(truth + "/labels") || fs::is_directory(truth + "/masks");
}

std::vector<Command> EvaluationCommands(const SuiteJob& job, const std::string& folder,
                                        const SuitePrograms& programs) {
  std::vector<Command> commands;
  const std::string truth = TruthFolder(job, folder);
  if (truth.empty()) return commands;
  const std::string exclude = ExcludeFile(job, folder, truth);
  const auto add_trajectory = [&](const std::string& estimate, const std::string& out) {
    commands.push_back({programs.evaluate_trajectory(), "--groundtruth", truth + "/groundtruth.txt",
                        "--estimate", folder + "/" + estimate, "--out", out});
    if (!exclude.empty()) commands.back().insert(commands.back().end(), {"--exclude", exclude});
  };
  add_trajectory("trajectory.txt", folder);
  add_trajectory("trajectory_live.txt", folder + "/live");
  if (fs::exists(truth + "/world.ply")) {
    commands.push_back(
        {programs.evaluate_map(), "--map", folder + "/map.ply", "--truth", truth, "--out", folder});
  }
  const std::string masks = folder + "/masks";
  if (fs::is_directory(masks) && !fs::is_empty(masks) && HasTrueMasks(truth)) {
    commands.push_back({programs.evaluate_masks(), "--truth", truth, "--estimate", masks,
                        "--only-estimated", "--out", folder});
  }
  if (fs::exists(truth + "/blur.txt")) {
    commands.push_back({programs.evaluate_blur(), "--truth", truth, "--frames",
                        folder + "/frames.txt", "--out", folder});
  }
  return commands;
}

/// Runs one program of a job. @throws std::runtime_error when it fails.
void RunLogged(const Command& command, const std::string& log_path,
               const std::function<bool()>& should_stop, bool& stopped) {
  std::ofstream log(log_path, std::ios::app);
  for (const std::string& word : command) log << word << " ";
  log << std::endl;
  const ChildExit exit = RunChild(command, log_path, should_stop);
  stopped = exit.stopped;
  if (exit.stopped || exit.IsSuccess()) return;
  const std::string program = fs::path(command.front()).filename();
  throw std::runtime_error(exit.signal != 0
                               ? program + " was ended by signal " + std::to_string(exit.signal)
                               : program + " failed with exit code " + std::to_string(exit.code));
}

/// Runs all programs of a job. False when stopped on the way.
bool RunPrograms(const SuiteJob& job, const std::string& folder, const SuitePrograms& programs,
                 const std::function<bool()>& should_stop) {
  const std::string log_path = folder + "/" + kLogFile;
  bool stopped = false;
  RunLogged(RunCommand(job, folder, programs), log_path, should_stop, stopped);
  if (stopped) return false;
  for (const Command& command : EvaluationCommands(job, folder, programs)) {
    RunLogged(command, log_path, should_stop, stopped);
    if (stopped) return false;
  }
  return true;
}

}  // namespace

SuitePrograms::SuitePrograms(const std::string& folder) {
  Hash hash;
  for (const char* name :
       {"run_dataset", "evaluate_trajectory", "evaluate_map", "evaluate_blur", "evaluate_masks"}) {
    paths_.push_back((fs::path(folder) / name).string());
    if (access(paths_.back().c_str(), X_OK) != 0) {
      throw std::runtime_error(paths_.back() + ": there is no such program");
    }
    hash.Add(ReadWholeFile(paths_.back()));
  }
  fingerprint_ = hash.value();
}

const char* ToString(JobState state) {
  switch (state) {
    case JobState::kDone:
      return "done";
    case JobState::kFailed:
      return "failed";
    case JobState::kStopped:
      return "stopped";
  }
  return "";
}

std::string JobFolder(const std::string& out, const SuiteJob& job) {
  return out + "/jobs/" + job.id;
}

std::optional<JobRecord> FindRecord(const SuiteJob& job, const std::string& folder,
                                    const SuitePrograms& programs) {
  const std::string path = folder + "/" + kStampFile;
  if (!fs::exists(path)) return std::nullopt;
  const auto json = nlohmann::json::parse(ReadWholeFile(path), nullptr, /*exceptions=*/false);
  if (!json.is_object() || json.value("stamp", "") != StampText(job, folder, programs)) {
    return std::nullopt;
  }
  return JobRecord{json.value("wall_s", 0.0)};
}

JobResult RunJob(const SuiteJob& job, const std::string& folder, const SuitePrograms& programs,
                 const std::function<bool()>& should_stop) {
  JobResult result;
  const auto start = std::chrono::steady_clock::now();
  try {
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::string stamp = StampText(job, folder, programs);
    if (!RunPrograms(job, folder, programs, should_stop)) return result;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    result.record.wall_s = wall.count();
    const nlohmann::json done = {{"stamp", stamp}, {"wall_s", result.record.wall_s}};
    WriteFileAtomically(folder + "/" + kStampFile, done.dump(2) + "\n");
    result.state = JobState::kDone;
  } catch (const std::exception& error) {
    result.state = JobState::kFailed;
    result.problem = std::string(error.what()) + "; see " + folder + "/" + kLogFile;
  }
  return result;
}

}  // namespace posefusion
