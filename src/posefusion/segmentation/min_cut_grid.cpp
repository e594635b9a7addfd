#include "posefusion/segmentation/min_cut_grid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace posefusion {
namespace {

using Graph = cv::detail::GCGraph<int>;

constexpr float kWeightScale = 1000;  ///< whole numbers: a flow that ends exactly
constexpr int kCertain = 10000000;    ///< more than all edges of a vertex together

/// Half of the eight neighbours; the others follow from symmetry.
const cv::Point kNeighbours[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

int Scaled(float weight) { return static_cast<int>(std::lround(weight * kWeightScale)); }

/// How far a point lies beyond the reach of all seeds and unseen parts, metres; not positive
/// within.
float BeyondReach(const Eigen::Vector3f& p_camera, float distance_m, float reach_m,
                  const std::vector<UnseenPart>& parts) {
  float beyond = distance_m - reach_m;
  for (const UnseenPart& part : parts) {
    if (beyond <= 0) break;
    beyond = std::min(beyond, (part.p_camera - p_camera).norm() - part.radius_m);
  }
  return beyond;
}

bool LeavesImage(const Eigen::Vector3f& p_camera, const std::vector<UnseenPart>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const UnseenPart& part) {
    return part.leaves_image &&
           (part.p_camera - p_camera).squaredNorm() < part.radius_m * part.radius_m;
  });
}

}  // namespace

MinCutGrid::MinCutGrid(const MinCutConfig& config) : config_(config) {}

void MinCutGrid::AddVertices(const CutProblem& problem) {
  vertices_.Resize(problem.region.width, problem.region.height);
  vertices_.Fill(-1);
  points_.clear();
  places_.clear();
  for (int y = 0; y < problem.region.height; ++y) {
    for (int x = 0; x < problem.region.width; ++x) {
      if (problem.states.at(x, y) == CellState::kOutside) continue;
      vertices_.at(x, y) = static_cast<int>(points_.size());
      points_.push_back(problem.cells->PointAt(problem.region.x + x, problem.region.y + y));
      places_.emplace_back(x, y);
    }
  }
}

int MinCutGrid::SmoothnessWeight(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                 float share) const {
  const auto sigma = static_cast<float>(config_.sigma_m);
  const auto gap_sigma = static_cast<float>(config_.depth_gap_sigma_m);
  const float gap = a.z() - b.z();
  const float exponent =
      (a - b).squaredNorm() / (sigma * sigma) + gap * gap / (gap_sigma * gap_sigma);
  return Scaled(share * std::exp(-exponent));
}

/// The end of a plane is an edge that depth and colour need not show.
float MinCutGrid::SurfaceShare(CellState a, CellState b) const {
  const bool ends = (a == CellState::kSurface) != (b == CellState::kSurface);
  return ends ? static_cast<float>(config_.surface_edge_share) : 1;
}

/// What the colours of two cells of the region leave of the cost of parting them.
float MinCutGrid::ColourShare(const CutProblem& problem, const cv::Point& a,
                              const cv::Point& b) const {
  if (problem.colours.empty()) return 1;
  const cv::Point origin = problem.region.tl();
  const auto& first = problem.colours.at<cv::Vec3b>(a + origin);
  const auto& second = problem.colours.at<cv::Vec3b>(b + origin);
  float squared = 0;
  for (int i = 0; i < 3; ++i) {
    const auto difference = static_cast<float>(first[i] - second[i]);
    squared += difference * difference;
  }
  const auto sigma = static_cast<float>(config_.colour_sigma);
  const auto least = static_cast<float>(config_.min_colour_share);
  return least + (1 - least) * std::exp(-squared / (sigma * sigma));
}

/// Equation 3. `p` is the point in the penalty's frame.
float MinCutGrid::PenaltyAt(const CutProblem& problem, const SeedDistance& distance,
                            const Eigen::Vector3f& p_camera, const Eigen::Vector3f& p) const {
  const SeedDistance::Squares squares = distance.To(p);
  const float beyond_m = BeyondReach(p_camera, std::sqrt(squares.distance),
                                     static_cast<float>(config_.reach_m), problem.unseen_parts);
  return LimitedPenalty(config_, static_cast<float>(problem.radius_m), std::sqrt(squares.in_shares),
                        beyond_m, LeavesImage(p_camera, problem.unseen_parts));
}

/// What the colour of a cell speaks for somebody, against the background.
float MinCutGrid::ColourGain(const CutProblem& problem, const cv::Point& cell) {
  if (problem.people_colours == nullptr || problem.colours.empty()) return 0;
  return static_cast<float>(problem.colour_weight) *
         problem.people_colours->LogRatio(problem.colours.at<cv::Vec3b>(cell));
}

/// What it costs to call a free cell background, and person.
MinCutGrid::CellCosts MinCutGrid::CostsOf(const CutProblem& problem, const SeedDistance& distance,
                                          std::size_t i, const Eigen::Vector3f& p) const {
  const cv::Point cell = problem.region.tl() + places_[i];
  if (problem.gains == nullptr) {
    const float gain = ColourGain(problem, cell);
    return {static_cast<float>(problem.source_weight) + std::max(gain, 0.0F),
            PenaltyAt(problem, distance, points_[i], p) + std::max(-gain, 0.0F)};
  }
  const float gain = problem.gains->at(cell.x, cell.y);
  return {std::max(gain, 0.0F), std::max(-gain, 0.0F)};
}

void MinCutGrid::Solve(const CutProblem& problem, cv::Mat& person) {
  person.create(problem.region.size(), CV_8UC1);
  person.setTo(0);
  AddVertices(problem);
  if (points_.empty()) return;
  const bool in_plane = config_.penalty_distance == PenaltyDistance::kPlane;
  const Eigen::Matrix3f R_penalty_camera = RotationToPenaltyFrame(problem.gravity);
  const auto in_penalty_frame = [&](const Eigen::Vector3f& p_camera) -> Eigen::Vector3f {
    if (!in_plane) return p_camera;
    Eigen::Vector3f p = R_penalty_camera * p_camera;
    p.z() = 0;
    return p;
  };
  seeds_.clear();
  for (const BodyPoint& seed : problem.seeds) {
    seeds_.push_back({in_penalty_frame(seed.p_camera), seed.radius_share});
  }
  const SeedDistance distance(seeds_);

  Graph graph(static_cast<unsigned>(points_.size()), static_cast<unsigned>(8 * points_.size()));
  const float cell_per_spacing =
      static_cast<float>(problem.cells->size_at_1m() / config_.spacing_m);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int vertex = graph.addVtx();
    const CellState state = problem.states.at(places_[i].x, places_[i].y);
    if (state == CellState::kFree) {
      const CellCosts costs = CostsOf(problem, distance, i, in_penalty_frame(points_[i]));
      const float scale = cell_per_spacing * points_[i].z();
      graph.addTermWeights(vertex, Scaled(scale * costs.as_background),
                           Scaled(scale * costs.as_person));
    } else {
      const bool is_person = state == CellState::kPerson;
      graph.addTermWeights(vertex, is_person ? kCertain : 0, is_person ? 0 : kCertain);
    }
  }
  const cv::Rect inside({0, 0}, problem.region.size());
  bool has_edges = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (const cv::Point& step : kNeighbours) {
      const cv::Point next = places_[i] + step;
      if (!inside.contains(next)) continue;
      const int other = vertices_.at(next.x, next.y);
      if (other < 0) continue;
      const float share = ColourShare(problem, places_[i], next) *
                          SurfaceShare(problem.states.at(places_[i].x, places_[i].y),
                                       problem.states.at(next.x, next.y));
      const int weight =
          SmoothnessWeight(points_[i], points_[static_cast<std::size_t>(other)], share);
      if (weight == 0) continue;
      graph.addEdges(static_cast<int>(i), other, weight, weight);
      has_edges = true;
    }
  }
  if (!has_edges) return;
  graph.maxFlow();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (graph.inSourceSegment(static_cast<int>(i))) {
      person.at<std::uint8_t>(places_[i]) = 255;
    }
  }
}

}  // namespace posefusion
