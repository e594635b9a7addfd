#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "posefusion/image/grid.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/people_colours.h"
#include "posefusion/segmentation/seed_distance.h"
#include "posefusion/segmentation/unseen_part.h"

namespace posefusion {

enum class MinCutBackend {
  kPcl,   ///< pcl::MinCutSegmentation: the paper's graph of nearest neighbours in space
  kGrid,  ///< graph of neighbouring cells of the image
};

/// What says of a cell by itself whether it is person.
enum class DataTerm {
  kPenalty,  ///< `source_weight` against the penalty of equation 3
  kLearned,  ///< log odds of trees learned from simulated people (own extension; only `grid`)
};

/// Between which points the background penalty (equation 3) is taken.
enum class PenaltyDistance {
  kPlane,  ///< in the horizontal plane, or the image plane where gravity is unknown, as in the
           ///< paper
  kSpace,  ///< in space (own extension; only `grid` has it): nothing behind a person is near it
};

struct MinCutConfig {
  MinCutBackend backend = MinCutBackend::kGrid;
  DataTerm data_term = DataTerm::kLearned;  ///< of people with keypoints; `pcl` has the penalty
  double log_odds_weight = 0.3;             ///< learned: of equation 2's unit, for each nat ...
  double log_odds_offset = 1.3;  ///< ... above minus this: to miss somebody is worse than a hole
  double penalty_weight = 0.5;   ///< learned: share of equation 3 beside it
  double radius_m = 0.20;        ///< r of equation 3: what is this far from all seeds costs 1
  double sigma_m = 0.25;         ///< sigma of equation 2
  double source_weight = 0.8;    ///< cost of calling a point background (PCL's default)
  PenaltyDistance penalty_distance = PenaltyDistance::kSpace;
  double max_penalty = 0.82;     ///< grid: equation 3 stops growing here (own extension) ...
  double reach_m = 0.35;         ///< ... and goes on this far from all seeds
  double unseen_penalty = 0.79;  ///< grid: its limit where a limb leaves the image (own extension)
  double depth_gap_sigma_m = 0.05;  ///< grid: edges over depth gaps cost less (own extension)
  double colour_sigma = 30;       ///< grid: edges over colour differences cost less (0 to 442) ...
  double min_colour_share = 0.2;  ///< ... down to this share (own extension)
  double surface_edge_share = 0.2;  ///< grid: share that edges from large planes to what lies on
                                    ///< them cost (own extension)
  double spacing_m = 0.015;  ///< grid: cells so far apart weigh equations 2 and 3 as they stand
  int pcl_neighbours = 14;   ///< pcl: edges of a point (PCL's default)
};

template <class V>
void Describe(V& v, MinCutConfig& c) {
  v.Choice("backend", c.backend, {"pcl", "grid"});
  v.Field("radius_m", c.radius_m, 0.02, 2.0);
  v.Field("sigma_m", c.sigma_m, 0.01, 5.0);
  v.Field("source_weight", c.source_weight, 0.01, 100.0);
  v.Choice("data_term", c.data_term, {"penalty", "learned"});
  v.Field("log_odds_weight", c.log_odds_weight, 0.0, 100.0);
  v.Field("log_odds_offset", c.log_odds_offset, -100.0, 100.0);
  v.Field("penalty_weight", c.penalty_weight, 0.0, 100.0);
  v.Choice("penalty_distance", c.penalty_distance, {"plane", "space"});
  v.Field("max_penalty", c.max_penalty, 0.1, 1000.0);
  v.Field("unseen_penalty", c.unseen_penalty, 0.1, 1000.0);
  v.Field("surface_edge_share", c.surface_edge_share, 0.0, 1.0);
  v.Field("depth_gap_sigma_m", c.depth_gap_sigma_m, 0.01, 100.0);
  v.Field("colour_sigma", c.colour_sigma, 1.0, 100000.0);
  v.Field("min_colour_share", c.min_colour_share, 0.0, 1.0);
  v.Field("reach_m", c.reach_m, 0.0, 10.0);
  v.Field("spacing_m", c.spacing_m, 0.001, 1.0);
  v.Field("pcl_neighbours", c.pcl_neighbours, 1, 100);
}

/// What is known of a cell before the cut.
enum class CellState : std::uint8_t {
  kOutside,     ///< no depth or out of the person's range: no vertex of the graph
  kFree,        ///< to be decided
  kPerson,      ///< certain; stays person whatever its neighbours are
  kBackground,  ///< certain
  kSurface,     ///< certain background on a large plane
};

/// One person to be cut out of a region of the cells.
struct CutProblem {
  const CellGrid* cells = nullptr;
  cv::Mat colours;  ///< CV_8UC3 of the cells; empty: not used (`grid`)
  /// What it costs more to call a cell background than person, of all cells; null: equation 3
  /// (`grid`).
  const Grid<float>* gains = nullptr;
  cv::Rect region;                         ///< of the cells; not empty
  Grid<CellState> states;                  ///< of the region
  std::vector<BodyPoint> seeds;            ///< foreground points
  std::vector<UnseenPart> unseen_parts;    ///< equation 3 does not go on inside these (`grid`)
  std::optional<Eigen::Vector3f> gravity;  ///< unit vector downwards, camera frame
  double radius_m = 0;                     ///< r of equation 3
  double source_weight = 0;                ///< cost of calling a free cell background
  const PeopleColours* people_colours = nullptr;  ///< beside equation 3 (`grid`); null: not used
  double colour_weight = 0;  ///< cost of one nat of their log ratio (own extension)
};

/// Divides the cells of a region into person and background at least cost:
/// C = exp(-(len / sigma)^2) for neighbours that are parted (paper, equation 2), and for each cell
/// `source_weight` when background, P = (distance to the nearest seed) / r when person (equation
/// 3). `grid` takes the seeds' share of r, `pcl` the same r for all. Equal problems give equal
/// cuts. Not thread-safe.
class MinCut {
 public:
  virtual ~MinCut() = default;

  /// `person` becomes CV_8UC1 of the region's size, 255 = person. All 0 without seeds.
  virtual void Solve(const CutProblem& problem, cv::Mat& person) = 0;
};

/// Equation 3 with its limit and its reach: level between the limit and the end of the reach.
/// `in_share_m` is the distance from the nearest seed, divided by the seed's share of r; `beyond_m`
/// how far the point lies out of the reach (not positive: within); `leaves_image` whether a limb
/// goes on there outside the image.
float LimitedPenalty(const MinCutConfig& config, float radius_m, float in_share_m, float beyond_m,
                     bool leaves_image);

/// Turns camera points so that the X-Y plane is that of equation 3: horizontal, with z downwards,
/// where gravity is known; else the image plane.
Eigen::Matrix3f RotationToPenaltyFrame(const std::optional<Eigen::Vector3f>& gravity);

std::unique_ptr<MinCut> MakeMinCut(const MinCutConfig& config);

}  // namespace posefusion
