#include "posefusion/segmentation/human_remover.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "posefusion/config/config.h"
#include "posefusion/segmentation/camera_motion.h"
#include "posefusion/segmentation/frame_history.h"
#include "posefusion/segmentation/motion_field.h"
#include "posefusion/segmentation/people_memory.h"
#include "posefusion/segmentation/person_tracks.h"

namespace posefusion {

namespace {

/// Cells this close to a seed, metres, have the colours of people for certain.
constexpr double kOnSeedsM = 0.03;

/// Share of the joints of the trunk that were found.
float TrunkShare(const PersonSeeds& person) {
  constexpr CocoJoint kTrunk[] = {kNeck, kRightShoulder, kLeftShoulder, kRightHip, kLeftHip};
  float found = 0;
  for (const CocoJoint joint : kTrunk) found += person.found[joint] ? 1.0F : 0.0F;
  return found / static_cast<float>(std::size(kTrunk));
}

}  // namespace

struct HumanRemover::State {
  explicit State(const HumanRemovalConfig& given)
      : config(given),
        cutter(given),
        people_colours(given.people_colours),
        history(given.cells, given.history_s),
        tracks(given.hold) {}

  /// Seconds since the first frame.
  double Time(StampNs stamp_ns) const { return SecondsBetween(origin_ns, stamp_ns); }

  void Check(const RgbdFrame& frame) const;
  void Append(const RgbdFrame& frame, const std::optional<Eigen::Vector3f>& gravity);
  const Skeletons* Newest(const std::vector<Skeletons>& arrived);
  void ForgetWhatIsTooOld(StampNs now_ns);
  void CarryInto(std::size_t index);
  void FindNear(std::size_t index, const Skeletons* skeletons);
  void TakePlanes(std::size_t index);
  void CutAt(std::size_t index, const Skeletons* skeletons, cv::Mat& mask);
  void CutSkeletons(PastFrame& entry, const Skeletons& skeletons, double time_s);
  void MarkSure(const PastFrame& entry);
  void MarkNearSeeds(const CellGrid& cells, double radius_m, std::uint8_t value);
  void CutCarried(PastFrame& entry, double time_s, bool by_keypoints);
  CellSeeds SeedsOf(const CellPeople& people, CellPerson person) const;
  void KeepCuts(std::vector<PersonCut>& cuts) const;
  int CountPeople(const PastFrame& entry);

  HumanRemovalConfig config;
  std::optional<PersonCutter> cutter;
  MotionField motion_field;
  CameraMotion camera_motion;
  VelocityMeter velocity_meter;
  PeopleColours people_colours;
  CellListener on_cell;  ///< null: nobody is told
  FrameHistory history;
  PersonTracks tracks;
  StampNs origin_ns = 0;
  std::optional<StampNs> last_stamp_ns;
  std::optional<StampNs> newest_keypoints_ns;
  KeypointCounts counts;
  std::vector<PersonSeeds> seeds;
  KeypointCuts seen;               ///< cut with keypoints
  std::vector<PersonCut> carried;  ///< cut with carried cells
  cv::Mat cell_mask;
  cv::Mat known_people;  ///< of the frame that is cut, by those before
  cv::Mat past_mask;
};

void HumanRemover::State::Check(const RgbdFrame& frame) const {
  CheckFrame(frame, "frame " + FormatStamp(frame.stamp_ns));
  CheckFollows(frame.stamp_ns, last_stamp_ns);
}

void HumanRemover::State::Append(const RgbdFrame& frame,
                                 const std::optional<Eigen::Vector3f>& gravity) {
  if (!last_stamp_ns) origin_ns = frame.stamp_ns;
  last_stamp_ns = frame.stamp_ns;
  PastFrame& now = history.Push(frame, gravity);
  now.cells.Build(frame.depth_m, frame.camera);
  ReduceToCells(frame.rgb, now.cells.size(), now.grey);
  now.motion.release();
  now.T_before_now.reset();
  if (history.size() < 2) return;
  const PastFrame& before = history[history.size() - 2];
  if (before.grey.size() != now.grey.size()) return;
  motion_field.Estimate(now.grey, before.grey, now.motion);
  if (!config.remembered_people.enabled) return;
  now.T_before_now = camera_motion.Estimate(
      {before.cells, now.cells, before.people, before.grey, now.grey, now.motion});
}

/// The newest keypoints of a known frame; older ones would change nothing.
const Skeletons* HumanRemover::State::Newest(const std::vector<Skeletons>& arrived) {
  const Skeletons* newest = nullptr;
  for (const Skeletons& skeletons : arrived) {
    const bool is_too_late =
        config.policy == KeypointPolicy::kPass && skeletons.stamp_ns != last_stamp_ns;
    if (is_too_late || history.Find(skeletons.stamp_ns) == history.size()) {
      ++counts.unmatched;
      continue;
    }
    ++counts.used;
    if (newest_keypoints_ns && skeletons.stamp_ns <= *newest_keypoints_ns) continue;
    if (newest == nullptr || skeletons.stamp_ns > newest->stamp_ns) newest = &skeletons;
  }
  if (newest != nullptr) newest_keypoints_ns = newest->stamp_ns;
  return newest;
}

void HumanRemover::State::ForgetWhatIsTooOld(StampNs now_ns) {
  if (!newest_keypoints_ns) return;
  const double age_s = SecondsBetween(*newest_keypoints_ns, now_ns);
  if (config.policy == KeypointPolicy::kPass || age_s > config.hold.max_mask_age_s) tracks.Clear();
}

void HumanRemover::State::CarryInto(std::size_t index) {
  PastFrame& now = history[index];
  now.remembered.clear();
  now.velocities.fill(std::nullopt);
  if (index == 0 || now.motion.empty()) {
    now.people.Forget(now.cells.size());
    return;
  }
  const PastFrame& before = history[index - 1];
  CarryPeople(before.people, before.cells, now.motion, now.cells,
              SecondsBetween(before.frame.stamp_ns, now.frame.stamp_ns), config.carry, now.people);
  now.velocities = before.velocities;
  if (!now.T_before_now) return;
  const Eigen::Isometry3f T_before_now = now.T_before_now->cast<float>();
  velocity_meter.Update({before.cells, now.cells, now.people, now.motion, T_before_now,
                         SecondsBetween(before.frame.stamp_ns, now.frame.stamp_ns)},
                        now.velocities);
  RememberPeople({before.people, before.cells, before.remembered, Time(before.frame.stamp_ns),
                  before.velocities},
                 T_before_now, now.cells, Time(now.frame.stamp_ns), config.remembered_people,
                 now.people, now.remembered);
}

void HumanRemover::State::KeepCuts(std::vector<PersonCut>& cuts) const {
  for (std::size_t i = 0; i < cuts.size(); ++i) cutter->cuts()[i].copyTo(cuts[i].cells);
}

void HumanRemover::State::CutSkeletons(PastFrame& entry, const Skeletons& skeletons,
                                       double time_s) {
  CutRequest request;
  request.skeletons = &skeletons;
  request.cells = &entry.cells;
  request.on_cell = on_cell;
  request.known_people = known_people;
  request.planes = &entry.planes;
  request.gravity = entry.gravity;
  request.people_colours = &people_colours;
  cutter->CutCells(entry.frame, request);
  seeds = cutter->people();
  seen.cuts.assign(skeletons.people.size(), PersonCut());
  KeepCuts(seen.cuts);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    seen.cuts[i].trunk = TrunkShare(seeds[i]);
    seen.cuts[i].num_certain_joints = seeds[i].num_certain_joints;
  }
  MarkSure(entry);
  RecognisePeople(entry.people, time_s, tracks, seen.cuts);
  for (const PersonCut& cut : seen.cuts) {
    if (cut.is_new) entry.velocities[cut.owner].reset();
  }
  tracks.NoteKeypoints(time_s);  // not before everybody could be recognised
}

/// Where the cuts made with keypoints know what is not person.
void HumanRemover::State::MarkSure(const PastFrame& entry) {
  const Grid<std::uint8_t>& surfaces = cutter->background_cells();
  const cv::Size size = entry.cells.size();
  seen.near_seeds.create(size, CV_8UC1);
  seen.near_seeds.setTo(kFarFromSeeds);
  seen.surfaces.create(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) seen.surfaces.at<std::uint8_t>(y, x) = surfaces.at(x, y);
  }
  MarkNearSeeds(entry.cells, config.hold.loss_radius_m, kNearSeeds);
  MarkNearSeeds(entry.cells, config.hold.gain_radius_m, kAtSeeds);
  MarkNearSeeds(entry.cells, kOnSeedsM, kOnSeeds);
}

void HumanRemover::State::MarkNearSeeds(const CellGrid& cells, double radius_m,
                                        std::uint8_t value) {
  const double radius_at_1m = radius_m / cells.size_at_1m();
  for (const PersonSeeds& person : seeds) {
    for (const Seed& seed : person.seeds) {
      const cv::Point2f cell = seed.pixel / static_cast<float>(cells.size_px());
      const auto radius = static_cast<int>(radius_at_1m / static_cast<double>(seed.p_camera.z()));
      cv::circle(seen.near_seeds, cell, radius, value, cv::FILLED);
    }
  }
}

CellSeeds HumanRemover::State::SeedsOf(const CellPeople& people, CellPerson person) const {
  const int width = people.person.width();
  const int height = people.person.height();
  CellSeeds cells{cv::Mat::zeros(height, width, CV_8UC1), cv::Mat::zeros(height, width, CV_8UC1)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const CellPerson who = people.person.at(x, y);
      const bool is_sure = people.evidence.at(x, y) >= kFirstEvidence;
      if (who == person && is_sure) cells.person.at<std::uint8_t>(y, x) = 255;
      if (who == kNobody && !IsWeakBackground(people, x, y))
        cells.background.at<std::uint8_t>(y, x) = 255;
    }
  }
  return cells;
}

/// People whom keypoints of this very frame do not show are cut by what was carried of them.
void HumanRemover::State::CutCarried(PastFrame& entry, double time_s, bool by_keypoints) {
  CutRequest request;
  request.cells = &entry.cells;
  request.gravity = entry.gravity;
  request.known_people = known_people;
  request.planes = &entry.planes;
  request.people_colours = &people_colours;
  carried.clear();
  const std::vector<int> cells = CountCells(entry.people);
  for (int number = kNobody + 1; number <= kMaxPersonNumber; ++number) {
    if (cells[static_cast<std::size_t>(number)] < config.hold.min_cells) continue;
    const auto person = static_cast<CellPerson>(number);
    if (by_keypoints && tracks.LastConfirmed(person) == time_s) continue;
    request.cell_seeds.push_back(SeedsOf(entry.people, person));
    carried.push_back({person, false, cv::Mat()});
  }
  if (carried.empty() && by_keypoints) return;  // the cells of the frame have been built
  cutter->CutCells(entry.frame, request);
  KeepCuts(carried);
}

/// People who are too near to be measured stay where the frame before saw them.
void HumanRemover::State::FindNear(std::size_t index, const Skeletons* skeletons) {
  PastFrame& entry = history[index];
  const bool is_carried = index > 0 && config.policy != KeypointPolicy::kPass;
  entry.near_people = FindNearPeople(entry.cells, skeletons,
                                     is_carried ? history[index - 1].near_people : NearPeople(),
                                     Time(entry.frame.stamp_ns), config.near_people);
}

/// The large surfaces that the frame before saw.
void HumanRemover::State::TakePlanes(std::size_t index) {
  history[index].planes = index > 0 ? history[index - 1].planes : std::vector<Plane>();
}

void HumanRemover::State::CutAt(std::size_t index, const Skeletons* skeletons, cv::Mat& mask) {
  PastFrame& entry = history[index];
  const double time_s = Time(entry.frame.stamp_ns);
  const bool by_keypoints = skeletons != nullptr;
  TakePlanes(index);
  ReleasePeople(tracks, entry.people);
  MarkKnown(entry.people, known_people);
  if (by_keypoints) CutSkeletons(entry, *skeletons, time_s);
  CutCarried(entry, time_s, by_keypoints);
  UpdatePeople(by_keypoints ? &seen : nullptr, carried, entry.cells, time_s, tracks, entry.people);
  if (by_keypoints) people_colours.Add(cutter->colours(), entry.people, seen.near_seeds);
  MarkPeople(entry.people, cell_mask);
  FindNear(index, skeletons);
  if (!entry.near_people.cells.empty()) cell_mask.setTo(255, entry.near_people.cells);
  cutter->Refine(entry.frame, cell_mask, mask);
}

/// People of enough cells; the others are forgotten.
int HumanRemover::State::CountPeople(const PastFrame& entry) {
  const std::vector<int> cells = CountCells(entry.people);
  std::vector<int> places(cells.size(), 0);
  for (const RememberedPlace& place : entry.remembered) ++places[place.person];
  int num_people = 0;
  for (int number = kNobody + 1; number <= kMaxPersonNumber; ++number) {
    if (cells[static_cast<std::size_t>(number)] >= config.hold.min_cells) {
      ++num_people;
    } else if (places[static_cast<std::size_t>(number)] < config.hold.min_cells) {
      tracks.Forget(static_cast<CellPerson>(number));
    }
  }
  return num_people;
}

HumanRemover::HumanRemover(const HumanRemovalConfig& config) {
  CheckRanges("human_removal", config);
  state_ = std::make_unique<State>(config);
}

HumanRemover::~HumanRemover() = default;

HumanCut HumanRemover::Process(const RgbdFrame& frame, const std::vector<Skeletons>& arrived,
                               const std::optional<Eigen::Vector3f>& gravity) {
  State& s = *state_;
  s.Check(frame);
  s.Append(frame, gravity);
  const std::size_t last = s.history.size() - 1;
  const Skeletons* newest = s.Newest(arrived);
  HumanCut result;
  result.has_own_keypoints = newest != nullptr && newest->stamp_ns == frame.stamp_ns;
  s.ForgetWhatIsTooOld(frame.stamp_ns);
  if (newest != nullptr && !result.has_own_keypoints) {
    const std::size_t then = s.history.Find(newest->stamp_ns);
    s.CutAt(then, newest, s.past_mask);
    for (std::size_t index = then + 1; index < last; ++index) {
      s.CarryInto(index);
      s.FindNear(index, nullptr);
    }
  }
  s.CarryInto(last);
  s.CutAt(last, result.has_own_keypoints ? newest : nullptr, result.mask);
  result.num_people = s.CountPeople(s.history[last]);
  if (!s.history[last].near_people.cells.empty()) {
    result.num_people = std::max(result.num_people, 1);
  }
  if (s.newest_keypoints_ns) {
    result.mask_age_s = SecondsBetween(*s.newest_keypoints_ns, frame.stamp_ns);
  }
  return result;
}

void HumanRemover::Follow(const RgbdFrame& frame, const std::optional<Eigen::Vector3f>& gravity) {
  State& s = *state_;
  s.Check(frame);
  if (s.config.policy == KeypointPolicy::kPass) return;
  s.Append(frame, gravity);
  s.ForgetWhatIsTooOld(frame.stamp_ns);
  const std::size_t last = s.history.size() - 1;
  s.CarryInto(last);
  s.FindNear(last, nullptr);
  s.TakePlanes(last);
}

void HumanRemover::Adopt(const HumanRemovalConfig& config) {
  HumanRemovalConfig changed = state_->config;
  changed.policy = config.policy;
  changed.max_wait_s = config.max_wait_s;
  changed.seeds = config.seeds;
  changed.min_cut = config.min_cut;
  CheckRanges("human_removal", changed);
  state_->cutter.emplace(changed);
  state_->config = changed;
}

void HumanRemover::Reset() {
  const HumanRemovalConfig config = state_->config;
  state_ = std::make_unique<State>(config);
}

void HumanRemover::SetOnCell(CellListener on_cell) { state_->on_cell = std::move(on_cell); }

const std::vector<PersonSeeds>& HumanRemover::seeds() const { return state_->seeds; }
const KeypointCounts& HumanRemover::counts() const { return state_->counts; }
const HumanRemovalConfig& HumanRemover::config() const { return state_->config; }

}  // namespace posefusion
