#include "posefusion/evaluation/coverage.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/text_lines.h"

namespace posefusion {
namespace {

constexpr StampNs kSameFrameNs = 1'000'000;
constexpr StampNs kNearbyNs = 100'000'000;
constexpr char kDroppedState[] = "dropped";

/// Whether the estimate has a pose at most `tolerance_ns` away.
bool HasPoseAt(const Trajectory& estimate, StampNs stamp_ns, StampNs tolerance_ns) {
  const auto candidate = std::lower_bound(
      estimate.begin(), estimate.end(), stamp_ns - tolerance_ns,
      [](const StampedPose& pose, StampNs stamp) { return pose.stamp_ns < stamp; });
  return candidate != estimate.end() && candidate->stamp_ns <= stamp_ns + tolerance_ns;
}

Coverage CoverageOfStamps(const Trajectory& estimate, const std::vector<StampNs>& stamps_ns,
                          const std::vector<StampInterval>& excluded, StampNs tolerance_ns,
                          CoverageBasis basis) {
  Coverage coverage;
  coverage.basis = basis;
  for (const StampNs stamp_ns : stamps_ns) {
    if (IsInside(stamp_ns, excluded)) continue;
    ++coverage.num_expected;
    if (HasPoseAt(estimate, stamp_ns, tolerance_ns)) ++coverage.num_covered;
  }
  return coverage;
}

bool IsDropped(const TextLine& line) {
  return line.columns.size() > 1 && line.columns[1].rfind(kDroppedState, 0) == 0;
}

}  // namespace

const char* ToString(CoverageBasis basis) {
  switch (basis) {
    case CoverageBasis::kFrames:
      return "frames";
    case CoverageBasis::kReport:
      return "report";
    case CoverageBasis::kTruth:
      return "truth";
  }
  return "";
}

double Coverage::Ratio() const {
  return num_expected == 0 ? 1.0 : static_cast<double>(num_covered) / num_expected;
}

std::vector<StampNs> ReadExpectedFrames(const std::string& path) {
  std::vector<StampNs> frames_ns;
  for (const TextLine& line : ReadTextLines(path)) {
    const auto stamp_ns = ParseStamp(line.columns.front());
    if (!stamp_ns) throw std::runtime_error(LineName(path, line) + ": expected 'stamp [state]'");
    if (!IsDropped(line)) frames_ns.push_back(*stamp_ns);
  }
  return frames_ns;
}

std::optional<FrameCounts> ReadFrameCounts(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const auto frames = nlohmann::json::parse(ReadWholeFile(path)).at("frames");
    return FrameCounts{frames.at("total").get<int>(), frames.at("dropped_blur").get<int>()};
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path + ": no frame counts: " + error.what());
  }
}

Coverage CoverageOfFrames(const Trajectory& estimate, const std::vector<StampNs>& frames_ns,
                          const std::vector<StampInterval>& excluded) {
  return CoverageOfStamps(estimate, frames_ns, excluded, kSameFrameNs, CoverageBasis::kFrames);
}

Coverage CoverageOfCounts(const Trajectory& estimate, const FrameCounts& counts) {
  Coverage coverage;
  coverage.basis = CoverageBasis::kReport;
  coverage.num_expected = counts.total - counts.dropped_blur;
  coverage.num_covered = static_cast<int>(estimate.size());
  return coverage;
}

Coverage CoverageOfTruth(const Trajectory& estimate, const Trajectory& truth,
                         const std::vector<StampInterval>& excluded) {
  std::vector<StampNs> stamps_ns;
  for (const StampedPose& pose : truth) stamps_ns.push_back(pose.stamp_ns);
  return CoverageOfStamps(estimate, stamps_ns, excluded, kNearbyNs, CoverageBasis::kTruth);
}

}  // namespace posefusion
