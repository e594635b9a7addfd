#include "posefusion/segmentation/person_cutter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "posefusion/config/config.h"
#include "posefusion/segmentation/background_surfaces.h"
#include "posefusion/segmentation/boosted_trees.h"

namespace posefusion {
namespace {

constexpr std::size_t kMinSeeds = 2;        ///< of one person without a certain joint
constexpr float kSeedDepth = 0.05F;         ///< metres from the cell that shows a seed
constexpr float kMaxLogOdds = 5;            ///< nats: more is certain enough
constexpr float kCertainGain = 2;           ///< out of everybody's reach
constexpr std::size_t kMaxCellSeeds = 150;  ///< points that stand for certain cells

const HumanRemovalConfig& Checked(const HumanRemovalConfig& config) {
  CheckRanges("human_removal", config);
  return config;
}

}  // namespace

struct PersonCutter::Parts {
  explicit Parts(const HumanRemovalConfig& c)
      : config(c),
        cells(c.cells),
        surfaces(c.background_surfaces),
        min_cut(MakeMinCut(c.min_cut)),
        refinement(c.mask) {}

  const HumanRemovalConfig config;
  CellGrid cells;
  BackgroundSurfaces surfaces;
  std::unique_ptr<MinCut> min_cut;
  MaskRefinement refinement;
  std::vector<PersonSeeds> people;   ///< of the skeletons
  std::vector<PersonSeeds> carried;  ///< of the cell seeds
  Grid<std::uint8_t> background;     ///< cells on surfaces that are no person's
  CellFeatureReader features;
  Grid<float> gains;                              ///< CutProblem::gains
  const PeopleColours* people_colours = nullptr;  ///< null: not known
  CutProblem problem;
  cv::Mat cut;
  cv::Mat seeded;                ///< cells of the cut that are connected with certain ones
  std::vector<cv::Point> front;  ///< of the same, not looked around yet
  cv::Mat cell_mask;
  std::vector<cv::Mat> cuts;
  std::size_t current_cut = 0;

  /// A cut without anybody, to be filled by Solve().
  void BeginCut(std::size_t index) {
    if (cuts.size() <= index) cuts.resize(index + 1);
    cuts[index].create(cells.size(), CV_8UC1);
    cuts[index].setTo(0);
    current_cut = index;
  }

  /// Makes the cells of the region with depth in its range free.
  void OpenRegion(const PersonRegion& region) {
    problem.cells = &cells;
    problem.region = region.cells;
    problem.states.Resize(region.cells.width, region.cells.height);
    for (int y = 0; y < region.cells.height; ++y) {
      for (int x = 0; x < region.cells.width; ++x) {
        const float z = cells.DepthAt(region.cells.x + x, region.cells.y + y);
        const bool in_range = z > 0 && z >= region.min_depth_m && z <= region.max_depth_m;
        const bool on_surface = background.at(region.cells.x + x, region.cells.y + y) != 0;
        const bool is_certain = on_surface && problem.gains == nullptr;
        problem.states.at(x, y) = !in_range    ? CellState::kOutside
                                  : is_certain ? CellState::kSurface
                                               : CellState::kFree;
      }
    }
  }

  /// The cell that shows a seed is certainly person.
  void FixSeed(const Seed& seed) {
    const auto cell = cells.CellAt(seed.pixel);
    if (!cell || !problem.region.contains(*cell)) return;
    if (std::abs(cells.DepthAt(cell->x, cell->y) - seed.p_camera.z()) > kSeedDepth) return;
    problem.states.at(cell->x - problem.region.x, cell->y - problem.region.y) = CellState::kPerson;
  }

  /// Drops parts of the cut that no certain cell is connected with.
  void KeepSeededParts() {
    seeded.create(cut.size(), CV_8UC1);
    seeded.setTo(0);
    front.clear();
    const cv::Rect inside({0, 0}, cut.size());
    const auto depth_at = [&](const cv::Point& cell) {
      return cells.DepthAt(problem.region.x + cell.x, problem.region.y + cell.y);
    };
    for (int y = 0; y < cut.rows; ++y) {
      for (int x = 0; x < cut.cols; ++x) {
        if (problem.states.at(x, y) != CellState::kPerson) continue;
        seeded.at<std::uint8_t>(y, x) = 255;
        front.emplace_back(x, y);
      }
    }
    const auto gap_m = static_cast<float>(config.seeds.layer_gap_m);
    for (std::size_t i = 0; i < front.size(); ++i) {
      const cv::Point cell = front[i];
      for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
        for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
          const cv::Point next(x, y);
          if (!inside.contains(next) || seeded.at<std::uint8_t>(next) != 0) continue;
          if (cut.at<std::uint8_t>(next) == 0) continue;
          if (std::abs(depth_at(cell) - depth_at(next)) > gap_m) continue;
          seeded.at<std::uint8_t>(next) = 255;
          front.push_back(next);
        }
      }
    }
    seeded.copyTo(cut);
  }

  void Solve() {
    min_cut->Solve(problem, cut);
    if (problem.gains == nullptr) KeepSeededParts();
    cv::Mat part = cell_mask(problem.region);
    cv::bitwise_or(part, cut, part);
    cut.copyTo(cuts[current_cut](problem.region));
  }

  /// Cuts the person with these seeds out, seeds on background surfaces left out.
  bool OpenProblem(const PersonSeeds& person, const CameraModel& camera) {
    PersonSeeds kept = person;
    const auto is_on_background = [&](const Seed& seed) {
      return IsOnSurface(seed, cells, background);
    };
    kept.seeds.erase(std::remove_if(kept.seeds.begin(), kept.seeds.end(), is_on_background),
                     kept.seeds.end());
    const PersonRegion region = RegionOf(kept, cells, camera, config.region, problem.gravity);
    if (region.cells.empty()) return false;
    if (kept.seeds.size() < kMinSeeds && person.num_certain_joints == 0) return false;
    OpenRegion(region);
    problem.radius_m = config.min_cut.radius_m;
    problem.source_weight = config.min_cut.source_weight;
    problem.people_colours = nullptr;
    problem.seeds.clear();
    for (const Seed& seed : kept.seeds) {
      problem.seeds.push_back(seed.OnBody());
      FixSeed(seed);
    }
    problem.unseen_parts = person.unseen_parts;
    return true;
  }

  void CutPerson(const PersonSeeds& person, const CameraModel& camera) {
    if (OpenProblem(person, camera)) Solve();
  }

  /// Seeds from certain cells, and the same certain cells fixed.
  void CutCells(const CellSeeds& seeds, const PersonSeeds& person, const CameraModel& camera) {
    if (!OpenProblem(person, camera)) return;
    problem.radius_m = config.carry.radius_m;
    problem.source_weight = config.carry.source_weight;
    problem.people_colours = people_colours;
    problem.colour_weight = config.carry.colour_weight;
    FixCells(seeds);
    Solve();
  }

  /// Planes are looked for away from everybody.
  void FindSurfaces(const cv::Mat& known_people, std::vector<Plane>* planes) {
    std::vector<BodyPoint> seeds;
    for (const auto* persons : {&people, &carried}) {
      for (const PersonSeeds& person : *persons) {
        for (const Seed& seed : person.seeds) seeds.push_back(seed.OnBody());
        for (const UnseenPart& part : person.unseen_parts) seeds.push_back({part.p_camera});
      }
    }
    std::vector<Plane> none;
    surfaces.Find(cells, seeds, known_people, planes != nullptr ? *planes : none, background);
  }

  float GainOf(const CellFeatures& features) const;
  void ScoreCells(const CutRequest& request, const CameraModel& camera);
  cv::Rect PeoplesRegion(const CameraModel& camera) const;
  PersonSeeds SeedsOf(const CellSeeds& seeds) const;
  void FixCells(const CellSeeds& seeds);
};

/// All cells that any person of the skeletons can fill.
cv::Rect PersonCutter::Parts::PeoplesRegion(const CameraModel& camera) const {
  cv::Rect all;
  for (const PersonSeeds& person : people) {
    const cv::Rect one = RegionOf(person, cells, camera, config.region, problem.gravity).cells;
    all = all.empty() ? one : one.empty() ? all : all | one;
  }
  return all;
}

/// The learned data term of a cell, with its share of equation 3.
float PersonCutter::Parts::GainOf(const CellFeatures& f) const {
  const MinCutConfig& c = config.min_cut;
  const float log_odds = PersonTrees().Evaluate(f.data(), kMaxLogOdds);
  const float beyond_m =
      std::min(f[kSeedDistance] - static_cast<float>(c.reach_m), -f[kInUnseenPart]);
  const float penalty = LimitedPenalty(c, static_cast<float>(c.radius_m), f[kSeedDistanceShared],
                                       beyond_m, f[kLeavesImage] > 0);
  return static_cast<float>(c.log_odds_weight) *
             (log_odds + static_cast<float>(c.log_odds_offset)) +
         static_cast<float>(c.penalty_weight) * (static_cast<float>(c.source_weight) - penalty);
}

/// The learned data term of the cells that matter.
void PersonCutter::Parts::ScoreCells(const CutRequest& request, const CameraModel& camera) {
  gains.Resize(cells.width(), cells.height());
  gains.Fill(-kCertainGain);
  const CellScene scene{cells, problem.colours, background, people, people_colours};
  features.Open(scene);
  CellFeatures read;
  const cv::Rect region = PeoplesRegion(camera);
  for (int y = region.y; y < region.y + region.height; ++y) {
    for (int x = region.x; x < region.x + region.width; ++x) {
      if (!features.Read({x, y}, read)) continue;
      if (request.on_cell) request.on_cell({x, y}, read);
      gains.at(x, y) = GainOf(read);
    }
  }
}

PersonSeeds PersonCutter::Parts::SeedsOf(const CellSeeds& seeds) const {
  std::vector<cv::Point> places;
  for (int y = 0; y < cells.height(); ++y) {
    for (int x = 0; x < cells.width(); ++x) {
      const bool denied = !seeds.background.empty() && seeds.background.at<std::uint8_t>(y, x) != 0;
      if (seeds.person.at<std::uint8_t>(y, x) == 0 || denied || cells.DepthAt(x, y) <= 0) continue;
      places.emplace_back(x, y);
    }
  }
  PersonSeeds person;
  person.found.fill(true);  // nothing is known to be missing
  person.num_certain_joints = static_cast<int>(places.size());
  const std::size_t step = 1 + places.size() / kMaxCellSeeds;
  const float size = static_cast<float>(cells.size_px());
  std::vector<float> depths;
  for (std::size_t i = 0; i < places.size(); i += step) {
    const cv::Point place = places[i];
    const cv::Point2f centre((static_cast<float>(place.x) + 0.5F) * size - 0.5F,
                             (static_cast<float>(place.y) + 0.5F) * size - 0.5F);
    person.seeds.push_back({centre, cells.PointAt(place.x, place.y)});
    depths.push_back(cells.DepthAt(place.x, place.y));
  }
  if (depths.empty()) return person;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  person.body_depth_m = *middle;
  return person;
}

void PersonCutter::Parts::FixCells(const CellSeeds& seeds) {
  for (int y = 0; y < problem.region.height; ++y) {
    for (int x = 0; x < problem.region.width; ++x) {
      CellState& state = problem.states.at(x, y);
      if (state == CellState::kOutside) continue;
      const cv::Point cell(problem.region.x + x, problem.region.y + y);
      if (seeds.person.at<std::uint8_t>(cell) != 0) state = CellState::kPerson;
      if (!seeds.background.empty() && seeds.background.at<std::uint8_t>(cell) != 0) {
        state = CellState::kBackground;
      }
    }
  }
}

PersonCutter::PersonCutter(const HumanRemovalConfig& config)
    : parts_(std::make_unique<Parts>(Checked(config))) {}

PersonCutter::~PersonCutter() = default;

void PersonCutter::Cut(const RgbdFrame& frame, const CutRequest& request, cv::Mat& mask) {
  CutCells(frame, request);
  Refine(frame, parts_->cell_mask, mask);
}

void PersonCutter::Refine(const RgbdFrame& frame, const cv::Mat& cell_mask, cv::Mat& mask) {
  mask.create(frame.depth_m.size(), CV_8UC1);
  mask.setTo(0);
  parts_->refinement.Apply(cell_mask, parts_->cells, frame.depth_m, mask);
}

void PersonCutter::CutCells(const RgbdFrame& frame, const CutRequest& request) {
  Parts& p = *parts_;
  if (request.cells != nullptr) {
    p.cells = *request.cells;
  } else {
    p.cells.Build(frame.depth_m, frame.camera);
  }
  cv::resize(frame.rgb, p.problem.colours, p.cells.size(), 0, 0, cv::INTER_AREA);
  p.cell_mask.create(p.cells.size(), CV_8UC1);
  p.cell_mask.setTo(0);
  p.problem.gravity = request.gravity;
  p.people_colours = request.people_colours;
  p.people.clear();
  std::size_t num_cuts = 0;
  p.carried.clear();
  if (request.skeletons != nullptr) {
    for (const Skeleton& skeleton : request.skeletons->people) {
      p.people.push_back(LiftPerson(skeleton, frame, p.config.seeds, request.gravity));
    }
  }
  for (const CellSeeds& seeds : request.cell_seeds) p.carried.push_back(p.SeedsOf(seeds));
  p.FindSurfaces(request.known_people, request.planes);
  const bool is_learned = p.config.min_cut.backend == MinCutBackend::kGrid &&
                          p.config.min_cut.data_term == DataTerm::kLearned;
  if ((is_learned || request.on_cell) && !p.people.empty()) p.ScoreCells(request, frame.camera);
  if (is_learned && !p.people.empty()) p.problem.gains = &p.gains;
  for (const PersonSeeds& person : p.people) {
    p.BeginCut(num_cuts++);
    p.CutPerson(person, frame.camera);
  }
  p.problem.gains = nullptr;
  for (std::size_t i = 0; i < p.carried.size(); ++i) {
    p.BeginCut(num_cuts++);
    p.CutCells(request.cell_seeds[i], p.carried[i], frame.camera);
  }
  p.cuts.resize(num_cuts);
}

void PersonCutter::Cut(const RgbdFrame& frame, const Skeletons& skeletons, cv::Mat& mask) {
  CutRequest request;
  request.skeletons = &skeletons;
  Cut(frame, request, mask);
}

cv::Size PersonCutter::CellSize(const RgbdFrame& frame) const {
  const int size = parts_->config.cells.size_px;
  return {(frame.depth_m.cols + size - 1) / size, (frame.depth_m.rows + size - 1) / size};
}

const CellGrid& PersonCutter::cells() const { return parts_->cells; }
const Grid<std::uint8_t>& PersonCutter::background_cells() const { return parts_->background; }
const cv::Mat& PersonCutter::colours() const { return parts_->problem.colours; }
const std::vector<cv::Mat>& PersonCutter::cuts() const { return parts_->cuts; }
const std::vector<PersonSeeds>& PersonCutter::people() const { return parts_->people; }

}  // namespace posefusion
