#include "posefusion/evaluation/map_evaluation.h"

#include <cmath>
#include <filesystem>

#include "posefusion/common/parallel.h"
#include "posefusion/config/config.h"
#include "posefusion/dataset/camera_file.h"
#include "posefusion/dataset/mesh_file.h"
#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/evaluation/completeness.h"
#include "posefusion/evaluation/coverage.h"
#include "posefusion/evaluation/map_alignment.h"
#include "posefusion/evaluation/people_presence.h"
#include "posefusion/evaluation/true_surfaces.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxDifferenceS = 0.02;
constexpr double kSquareCmPerSquareM = 1e4;
constexpr int kGrain = 256;

/// A stable surfel, frame of the truth.
struct PlacedSurfel {
  Disc disc;
  StampNs first_seen_ns = 0;
  StampNs last_seen_ns = 0;
  std::optional<double> measured_m;  ///< from the camera at the last measurement
  double error_m = 0;                ///< from the nearest surface
};

std::vector<PlacedSurfel> PlaceStable(const SurfelCloud& map, const Trajectory& estimate,
                                      const Eigen::Isometry3d& T_truth_map, double min_confidence) {
  const Eigen::Isometry3f T = T_truth_map.cast<float>();
  std::vector<PlacedSurfel> surfels;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map.confidence[i] < static_cast<float>(min_confidence)) continue;
    PlacedSurfel surfel{{T * map.position_m[i], T.linear() * map.normal[i], map.radius_m[i]},
                        map.first_seen_ns[i],
                        map.last_seen_ns[i],
                        std::nullopt,
                        0};
    const StampedPose* pose = NearestPose(estimate, surfel.last_seen_ns, kMaxDifferenceS);
    if (pose != nullptr) {
      const Eigen::Vector3d p_map = map.position_m[i].cast<double>();
      surfel.measured_m = (p_map - pose->T_map_camera.translation()).norm();
    }
    surfels.push_back(surfel);
  }
  return surfels;
}

void MeasureErrors(const TrueSurfaces& surfaces, const ParallelRunner& runner,
                   std::vector<PlacedSurfel>& surfels) {
  runner.ForEachRange(static_cast<int>(surfels.size()), kGrain, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      PlacedSurfel& surfel = surfels[i];
      surfel.error_m =
          static_cast<double>(surfaces.Distance(surfel.disc.center, surfel.last_seen_ns));
    }
  });
}

void SummarizeErrors(const std::vector<PlacedSurfel>& surfels, const MapEvaluationConfig& config,
                     MapEvaluation& result) {
  std::vector<double> all_m;
  std::vector<double> near_m;
  std::vector<double> far_m;
  for (const PlacedSurfel& surfel : surfels) {
    all_m.push_back(surfel.error_m);
    if (!surfel.measured_m) ++result.num_unknown_distance;
    if (surfel.measured_m && *surfel.measured_m <= config.near_m) near_m.push_back(surfel.error_m);
    if (surfel.measured_m && *surfel.measured_m <= config.far_m) far_m.push_back(surfel.error_m);
  }
  result.all_m = Summarize(all_m);
  result.near_m = Summarize(near_m);
  result.far_m = Summarize(far_m);
}

/// True poses when the camera looked, at least a period apart.
std::vector<Eigen::Isometry3d> TrueViews(const MapTruth& truth, double period_s) {
  const auto stamps_ns = truth.frames_ns.empty() ? StampsOf(truth.trajectory) : truth.frames_ns;
  std::vector<Eigen::Isometry3d> views;
  std::optional<StampNs> last_ns;
  for (const StampNs stamp_ns : stamps_ns) {
    if (last_ns && SecondsBetween(*last_ns, stamp_ns) < period_s) continue;
    const StampedPose* pose = NearestPose(truth.trajectory, stamp_ns, kMaxDifferenceS);
    if (pose == nullptr) continue;
    views.push_back(pose->T_map_camera);
    last_ns = stamp_ns;
  }
  return views;
}

void MeasureCompleteness(const std::vector<PlacedSurfel>& surfels, const MapTruth& truth,
                         const MeshIndex& world, const MapEvaluationConfig& config,
                         const ParallelRunner& runner, MapEvaluation& result) {
  const Views views{truth.camera, TrueViews(truth, config.view_period_s), config.near_m};
  const auto samples = SampleSurface(truth.world, config.samples_per_m2, config.seed);
  const auto seen = SeenPoints(samples, world, views, runner);
  std::vector<Disc> discs;
  for (const PlacedSurfel& surfel : surfels) discs.push_back(surfel.disc);
  const int num_covered = CountCovered(seen, discs, config.covered_distance_m, runner);
  result.seen_m2 = static_cast<double>(seen.size()) / config.samples_per_m2;
  result.covered_m2 = num_covered / config.samples_per_m2;
}

GhostFigures Figures(const std::vector<Disc>& ghosts, std::size_t num_surfels, double thickness_m) {
  GhostFigures figures;
  figures.count = static_cast<int>(ghosts.size());
  if (num_surfels == 0) return figures;
  figures.share = static_cast<double>(ghosts.size()) / static_cast<double>(num_surfels);
  figures.area_cm2 = kSquareCmPerSquareM * UnionArea(ghosts, static_cast<float>(thickness_m));
  return figures;
}

void FindGhosts(const std::vector<PlacedSurfel>& surfels, const MapTruth& truth,
                const MapEvaluationConfig& config, MapEvaluation& result) {
  const PeoplePresence presence(truth.people.value_or(std::vector<PeopleAtStamp>()),
                                config.person_margin_m);
  std::vector<Disc> ghosts;
  std::vector<Disc> people;
  for (const PlacedSurfel& surfel : surfels) {
    if (surfel.error_m <= config.ghost_distance_m) continue;
    ghosts.push_back(surfel.disc);
    if (presence.WasAt(surfel.disc.center, surfel.first_seen_ns, surfel.last_seen_ns)) {
      people.push_back(surfel.disc);
    }
  }
  result.off_surface = Figures(ghosts, surfels.size(), config.union_thickness_m);
  if (truth.people) result.people = Figures(people, surfels.size(), config.union_thickness_m);
}

MapTruth ReadTruth(const fs::path& folder, const fs::path& frames_beside_map) {
  MapTruth truth;
  truth.world = ReadMesh(folder / "world.ply");
  truth.trajectory = ReadTrajectory(folder / "groundtruth.txt");
  truth.camera = ReadCameraFile(folder / "camera.yaml").camera;
  for (const fs::path& frames : {frames_beside_map, folder / "rgb.txt"}) {
    if (truth.frames_ns.empty() && fs::exists(frames)) truth.frames_ns = ReadExpectedFrames(frames);
  }
  const fs::path moved = folder / "moved_objects.txt";
  if (fs::exists(moved)) truth.moved = ReadMovedObjects(moved);
  const fs::path people = folder / "people_capsules.txt";
  if (fs::exists(people)) truth.people = ReadPeople(people);
  const fs::path events = folder / "events.txt";
  if (fs::exists(events)) truth.excluded = ReadIntervals(events);
  return truth;
}

}  // namespace

double MapEvaluation::Completeness() const { return seen_m2 > 0 ? covered_m2 / seen_m2 : 1; }

MapEvaluation EvaluateMap(const SurfelCloud& map, const Trajectory& estimate, const MapTruth& truth,
                          const MapEvaluationConfig& config) {
  CheckRanges("evaluate_map", config);
  const AbsoluteError error = ComputeAbsoluteError(truth.trajectory, estimate, truth.excluded);
  const ParallelRunner runner(config.num_threads);
  const TrueSurfaces surfaces(truth.world, truth.moved);
  MapEvaluation result;
  result.T_truth_map = AlignViews(error);
  result.num_pairs = static_cast<int>(error.pairs.size());
  auto surfels = PlaceStable(map, estimate, result.T_truth_map, config.min_confidence);
  result.num_surfels = static_cast<int>(map.size());
  result.num_stable = static_cast<int>(surfels.size());
  MeasureErrors(surfaces, runner, surfels);
  SummarizeErrors(surfels, config, result);
  MeasureCompleteness(surfels, truth, surfaces.world(), config, runner, result);
  FindGhosts(surfels, truth, config, result);
  return result;
}

MapEvaluation EvaluateMapFiles(const MapEvaluationFiles& files, const MapEvaluationConfig& config) {
  const fs::path folder = fs::path(files.map).parent_path();
  const std::string estimate =
      files.estimate.empty() ? (folder / "trajectory.txt").string() : files.estimate;
  const SurfelCloud map = ReadPly(files.map);
  const Trajectory trajectory = ReadTrajectory(estimate);
  const MapTruth truth = ReadTruth(files.truth, folder / "frames.txt");
  try {
    return EvaluateMap(map, trajectory, truth, config);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(estimate + " against " + files.truth + ": " + error.what());
  }
}

}  // namespace posefusion
