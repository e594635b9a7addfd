#include "posefusion/evaluation/trajectory_evaluation.h"

#include <filesystem>
#include <stdexcept>

#include "posefusion/dataset/trajectory_file.h"

namespace posefusion {
namespace {

Coverage ChooseCoverage(const Trajectory& truth, const Trajectory& estimate,
                        const EvaluationContext& context) {
  if (context.expected_frames) {
    return CoverageOfFrames(estimate, *context.expected_frames, context.excluded);
  }
  if (context.frame_counts && context.excluded.empty()) {
    return CoverageOfCounts(estimate, *context.frame_counts);
  }
  return CoverageOfTruth(estimate, truth, context.excluded);
}

EvaluationContext ReadContext(const EvaluationFiles& files) {
  const std::filesystem::path folder = std::filesystem::path(files.estimate).parent_path();
  const std::string beside = folder / "frames.txt";
  EvaluationContext context;
  if (!files.exclude.empty()) context.excluded = ReadIntervals(files.exclude);
  if (!files.frames.empty()) {
    context.expected_frames = ReadExpectedFrames(files.frames);
  } else if (std::filesystem::exists(beside)) {
    context.expected_frames = ReadExpectedFrames(beside);
  }
  context.frame_counts = ReadFrameCounts(folder / "report.json");
  return context;
}

}  // namespace

TrajectoryEvaluation EvaluateTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                        const EvaluationContext& context) {
  return {ComputeAbsoluteError(truth, estimate, context.excluded),
          ComputeRelativeError(truth, estimate, context.excluded),
          ChooseCoverage(truth, estimate, context), context.excluded};
}

TrajectoryEvaluation EvaluateFiles(const EvaluationFiles& files) {
  const Trajectory truth = ReadTrajectory(files.groundtruth);
  const Trajectory estimate = ReadTrajectory(files.estimate);
  const EvaluationContext context = ReadContext(files);
  try {
    return EvaluateTrajectory(truth, estimate, context);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(files.estimate + " against " + files.groundtruth + ": " +
                             error.what());
  }
}

}  // namespace posefusion
