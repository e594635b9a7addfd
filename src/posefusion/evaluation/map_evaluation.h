#pragma once

#include <optional>
#include <string>
#include <vector>

#include "posefusion/dataset/moved_objects_file.h"
#include "posefusion/dataset/people_file.h"
#include "posefusion/dataset/triangle_mesh.h"
#include "posefusion/evaluation/absolute_error.h"
#include "posefusion/evaluation/statistics.h"
#include "posefusion/image/camera_model.h"
#include "posefusion/surfel/surfel_cloud.h"

namespace posefusion {

/// What counts in the evaluation of a map.
struct MapEvaluationConfig {
  double min_confidence = 10;        ///< surfels below are unstable and do not count
  double near_m = 3;                 ///< surfels measured within it; what should be in the map
  double far_m = 4.5;                ///< surfels measured within it
  double covered_distance_m = 0.02;  ///< a surface so near to a surfel is in the map
  double ghost_distance_m = 0.05;    ///< surfels further from every static surface are ghosts
  double person_margin_m = 0.05;     ///< widens people, for noise of depth and pose
  double union_thickness_m = 0.02;   ///< discs so near above each other are one surface
  double samples_per_m2 = 1000;      ///< of the true surface
  double view_period_s = 0.1;        ///< steps along the true path in which surfaces are seen
  int seed = 1;                      ///< of the samples
  int num_threads = 2;
};

template <class V>
void Describe(V& v, MapEvaluationConfig& c) {
  v.Field("min_confidence", c.min_confidence, 0.0, 1e6);
  v.Field("near_m", c.near_m, 0.1, 100.0);
  v.Field("far_m", c.far_m, 0.1, 100.0);
  v.Field("covered_distance_m", c.covered_distance_m, 1e-4, 0.5);
  v.Field("ghost_distance_m", c.ghost_distance_m, 1e-4, 10.0);
  v.Field("person_margin_m", c.person_margin_m, 0.0, 1.0);
  v.Field("union_thickness_m", c.union_thickness_m, 1e-4, 0.5);
  v.Field("samples_per_m2", c.samples_per_m2, 1.0, 1e6);
  v.Field("view_period_s", c.view_period_s, 0.0, 60.0);
  v.Field("seed", c.seed, 0, 1'000'000'000);
  v.Field("num_threads", c.num_threads, 1, 256);
}

/// What is true, in the frame of the truth.
struct MapTruth {
  TriangleMesh world;  ///< everything that is not moved during the run
  std::vector<MovedSurfaces> moved;
  Trajectory trajectory;  ///< of the camera
  CameraModel camera;
  std::vector<StampNs> frames_ns;  ///< when the camera looked; empty: at all poses
  std::optional<std::vector<PeopleAtStamp>> people;
  std::vector<StampInterval> excluded;  ///< poses in these do not count for the alignment
};

/// A kind of surfels that should not be.
struct GhostFigures {
  int count = 0;
  double share = 0;     ///< of the stable surfels
  double area_cm2 = 0;  ///< of the union of their discs
};

/// How good a surfel map is. Surfels count when they are stable.
struct MapEvaluation {
  Eigen::Isometry3d T_truth_map = Eigen::Isometry3d::Identity();
  int num_pairs = 0;  ///< poses that the alignment rests on
  int num_surfels = 0;
  int num_stable = 0;
  int num_unknown_distance = 0;  ///< stable ones without a pose at their last measurement
  ErrorStatistics all_m;         ///< distance of surfel centers from the nearest surface
  ErrorStatistics near_m;        ///< the same of surfels last measured within config.near_m
  ErrorStatistics far_m;         ///< the same within config.far_m
  double seen_m2 = 0;            ///< surface seen within config.near_m
  double covered_m2 = 0;         ///< the part of it that is in the map
  GhostFigures off_surface;      ///< further than config.ghost_distance_m from every surface
  std::optional<GhostFigures>
      people;  ///< those of them where somebody was while they were measured

  /// covered / seen; 1 when nothing was seen.
  double Completeness() const;
};

/// Compares a surfel map with the truth. `estimate` are the poses that belong to the map, in stamp
/// order. The map is laid upon the truth by the trajectories alone (see AlignViews), not by fitting
/// surfaces, which would hide errors of the poses.
/// A thing that was moved is a surface for surfels last seen before it went, at its first place,
/// and for those last seen after it came, at its second. It does not count for completeness. How
/// far a surfel was at its last measurement follows from the estimated pose nearest to that stamp
/// (within 20 ms). People do not hide surfaces from the true camera.
/// @throws std::runtime_error when fewer than three poses are associated, std::invalid_argument for
/// a setting out of range or a world without triangles.
MapEvaluation EvaluateMap(const SurfelCloud& map, const Trajectory& estimate, const MapTruth& truth,
                          const MapEvaluationConfig& config = {});

/// Files of an evaluation. All but `map` and `truth` may be empty.
struct MapEvaluationFiles {
  std::string map;       ///< map.ply of run_dataset
  std::string truth;     ///< folder with world.ply, groundtruth.txt, camera.yaml and rgb.txt, and
                         ///< moved_objects.txt, people_capsules.txt and events.txt where there are
                         ///< any
  std::string estimate;  ///< poses of the map; default: trajectory.txt beside it
};

/// Reads the files; frames.txt beside the map tells which frames it was made of, otherwise rgb.txt.
/// @throws std::exception naming the file that cannot be read or evaluated.
MapEvaluation EvaluateMapFiles(const MapEvaluationFiles& files,
                               const MapEvaluationConfig& config = {});

}  // namespace posefusion
