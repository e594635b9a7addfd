#include "posefusion/segmentation/human_remover.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "posefusion/config/config.h"
#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/frame_history.h"
#include "posefusion/segmentation/motion_field.h"
#include "posefusion/segmentation/person_tracks.h"

namespace posefusion {
namespace {

/// A cut is of somebody known when it shares this much with them ...
constexpr double kSharedOfCut = 0.25;
/// ... or holds this much of them.
constexpr double kSharedOfPerson = 0.5;

using CellCounts = std::array<int, 256>;

template <class Body>
void ForEachCell(cv::Size size, const Body& body) {
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) body(x, y);
  }
}

CellCounts CountCells(const CellPeople& people) {
  CellCounts counts{};
  ForEachCell({people.person.width(), people.person.height()},
              [&](int x, int y) { ++counts[people.person.at(x, y)]; });
  return counts;
}

}  // namespace

struct HumanRemover::State {
  explicit State(const HumanRemovalConfig& given)
      : config(given), cutter(given), history(given.cells, given.history_s), tracks(given.hold) {}

  /// Seconds since the first frame.
  double Time(StampNs stamp_ns) const { return SecondsBetween(origin_ns, stamp_ns); }

  void Check(const RgbdFrame& frame) const;
  PastFrame& Append(const RgbdFrame& frame);
  const Skeletons* Newest(const std::vector<Skeletons>& arrived);
  void CarryInto(std::size_t index);
  void Release(CellPeople& people);
  void CutAt(std::size_t index, const Skeletons* skeletons,
             const std::optional<Eigen::Vector3f>& gravity, cv::Mat& mask);
  CutRequest RequestFor(const CellPeople& people, std::vector<CellPerson>& carried) const;
  std::vector<CellPerson> Recognise(const CellPeople& people, std::size_t num_skeletons,
                                    double time_s);
  void TakeOver(const std::vector<CellPerson>& owners, std::size_t num_skeletons, double time_s,
                const CellGrid& cells, CellPeople& people);
  int CountPeople(const CellPeople& people);
  void ForgetWhatIsTooOld(StampNs now_ns);

  HumanRemovalConfig config;
  PersonCutter cutter;
  MotionField motion_field;
  FrameHistory history;
  PersonTracks tracks;
  StampNs origin_ns = 0;
  std::optional<StampNs> last_stamp_ns;
  std::optional<StampNs> newest_keypoints_ns;
  KeypointCounts counts;
  cv::Mat past_mask;
};

void HumanRemover::State::Check(const RgbdFrame& frame) const {
  CheckFrame(frame, "frame " + FormatStamp(frame.stamp_ns));
  if (last_stamp_ns && frame.stamp_ns <= *last_stamp_ns) {
    throw std::invalid_argument("stamp " + FormatStamp(frame.stamp_ns) + " does not follow " +
                                FormatStamp(*last_stamp_ns));
  }
}

PastFrame& HumanRemover::State::Append(const RgbdFrame& frame) {
  if (!last_stamp_ns) origin_ns = frame.stamp_ns;
  last_stamp_ns = frame.stamp_ns;
  const bool follows = history.size() > 0;
  PastFrame& now = history.Push(frame);
  now.cells.Build(frame.depth_m, frame.camera);
  ReduceToCells(frame.rgb, now.cells.size(), now.grey);
  const PastFrame* before = follows && history.size() > 1 ? &history[history.size() - 2] : nullptr;
  if (before != nullptr && before->grey.size() == now.grey.size()) {
    motion_field.Estimate(now.grey, before->grey, now.motion);
  } else {
    now.motion.release();
  }
  return now;
}

/// The newest keypoints of a known frame; older ones would change nothing.
const Skeletons* HumanRemover::State::Newest(const std::vector<Skeletons>& arrived) {
  const Skeletons* newest = nullptr;
  for (const Skeletons& skeletons : arrived) {
    if (history.Find(skeletons.stamp_ns) == history.size()) {
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

void HumanRemover::State::CarryInto(std::size_t index) {
  PastFrame& now = history[index];
  if (index == 0 || now.motion.empty()) {
    now.people.person.Resize(now.cells.width(), now.cells.height());
    now.people.confirmed_s.Resize(now.cells.width(), now.cells.height());
    now.people.person.Fill(kUnknownCell);
    now.people.confirmed_s.Fill(0);
    return;
  }
  const PastFrame& before = history[index - 1];
  CarryPeople(before.people, before.cells, now.motion, now.cells,
              SecondsBetween(before.frame.stamp_ns, now.frame.stamp_ns), config.carry, now.people);
}

/// Cells of people who are not believed in any more become unknown.
void HumanRemover::State::Release(CellPeople& people) {
  ForEachCell({people.person.width(), people.person.height()}, [&](int x, int y) {
    CellPerson& person = people.person.at(x, y);
    if (person == kNobody || person == kUnknownCell) return;
    const auto confirmed_s = static_cast<double>(people.confirmed_s.at(x, y));
    if (!tracks.Holds(person, confirmed_s)) person = kUnknownCell;
  });
}

/// One carried cut for each person; `carried` says whose.
CutRequest HumanRemover::State::RequestFor(const CellPeople& people,
                                           std::vector<CellPerson>& carried) const {
  CutRequest request;
  const CellCounts cells = CountCells(people);
  const cv::Size size(people.person.width(), people.person.height());
  for (int number = kNobody + 1; number <= kMaxPersonNumber; ++number) {
    if (cells[static_cast<std::size_t>(number)] < config.hold.min_cells) continue;
    CellSeeds seeds{cv::Mat::zeros(size, CV_8UC1), cv::Mat::zeros(size, CV_8UC1)};
    ForEachCell(size, [&](int x, int y) {
      const CellPerson person = people.person.at(x, y);
      if (person == number) seeds.person.at<std::uint8_t>(y, x) = 255;
      if (person == kNobody) seeds.background.at<std::uint8_t>(y, x) = 255;
    });
    request.cell_seeds.push_back(std::move(seeds));
    carried.push_back(static_cast<CellPerson>(number));
  }
  return request;
}

/// Who each person of the keypoints is, by what their cuts share with the people carried here.
std::vector<CellPerson> HumanRemover::State::Recognise(const CellPeople& people,
                                                       std::size_t num_skeletons, double time_s) {
  std::vector<CellPerson> owners;
  const CellCounts known = CountCells(people);
  for (std::size_t i = 0; i < num_skeletons; ++i) {
    const cv::Mat& cut = cutter.cuts()[i];
    CellCounts shared{};
    int size = 0;
    ForEachCell(cut.size(), [&](int x, int y) {
      if (cut.at<std::uint8_t>(y, x) == 0) return;
      ++size;
      ++shared[people.person.at(x, y)];
    });
    shared[kNobody] = 0;
    shared[kUnknownCell] = 0;
    const auto best =
        static_cast<std::size_t>(std::max_element(shared.begin(), shared.end()) - shared.begin());
    const bool is_known = shared[best] > 0 && (shared[best] >= kSharedOfCut * size ||
                                               shared[best] >= kSharedOfPerson * known[best]);
    if (size == 0) {
      owners.push_back(kNobody);
    } else if (is_known) {
      owners.push_back(static_cast<CellPerson>(best));
      tracks.Confirm(owners.back(), time_s);
    } else {
      owners.push_back(tracks.Add(time_s).value_or(kNobody));
    }
  }
  return owners;
}

/// What the cuts found becomes what is known of the frame's cells.
void HumanRemover::State::TakeOver(const std::vector<CellPerson>& owners, std::size_t num_skeletons,
                                   double time_s, const CellGrid& cells, CellPeople& people) {
  ForEachCell(cells.size(), [&](int x, int y) {
    CellPerson& person = people.person.at(x, y);
    float& confirmed_s = people.confirmed_s.at(x, y);
    for (std::size_t i = 0; i < owners.size(); ++i) {
      if (owners[i] == kNobody || cutter.cuts()[i].at<std::uint8_t>(y, x) == 0) continue;
      const bool by_keypoints = i < num_skeletons;
      if (by_keypoints) {
        confirmed_s = static_cast<float>(time_s);
      } else if (person != owners[i]) {
        confirmed_s = static_cast<float>(tracks.LastConfirmed(owners[i]));
      }
      person = owners[i];
      return;
    }
    person = cells.DepthAt(x, y) > 0 ? kNobody : kUnknownCell;
  });
}

/// People of enough cells; the others are forgotten.
int HumanRemover::State::CountPeople(const CellPeople& people) {
  const CellCounts cells = CountCells(people);
  int num_people = 0;
  for (int number = kNobody + 1; number <= kMaxPersonNumber; ++number) {
    if (cells[static_cast<std::size_t>(number)] >= config.hold.min_cells) {
      ++num_people;
    } else {
      tracks.Forget(static_cast<CellPerson>(number));
    }
  }
  return num_people;
}

void HumanRemover::State::ForgetWhatIsTooOld(StampNs now_ns) {
  if (!newest_keypoints_ns) return;
  const double age_s = SecondsBetween(*newest_keypoints_ns, now_ns);
  if (config.policy == KeypointPolicy::kPass || age_s > config.hold.max_mask_age_s) tracks.Clear();
}

void HumanRemover::State::CutAt(std::size_t index, const Skeletons* skeletons,
                                const std::optional<Eigen::Vector3f>& gravity, cv::Mat& mask) {
  PastFrame& entry = history[index];
  const double time_s = Time(entry.frame.stamp_ns);
  Release(entry.people);
  std::vector<CellPerson> carried;
  CutRequest request = RequestFor(entry.people, carried);
  request.skeletons = skeletons;
  request.gravity = gravity;
  cutter.Cut(entry.frame, request, mask);
  const std::size_t num_skeletons = skeletons != nullptr ? skeletons->people.size() : 0;
  std::vector<CellPerson> owners = Recognise(entry.people, num_skeletons, time_s);
  owners.insert(owners.end(), carried.begin(), carried.end());
  if (skeletons != nullptr) tracks.NoteKeypoints(time_s);  // first, everybody could be recognised
  TakeOver(owners, num_skeletons, time_s, entry.cells, entry.people);
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
  s.Append(frame);
  const std::size_t last = s.history.size() - 1;
  const Skeletons* newest = s.Newest(arrived);
  HumanCut result;
  result.has_own_keypoints = newest != nullptr && newest->stamp_ns == frame.stamp_ns;
  if (newest != nullptr && !result.has_own_keypoints) {
    const std::size_t then = s.history.Find(newest->stamp_ns);
    s.CutAt(then, newest, gravity, s.past_mask);
    for (std::size_t index = then + 1; index < last; ++index) s.CarryInto(index);
  }
  s.ForgetWhatIsTooOld(frame.stamp_ns);
  s.CarryInto(last);
  s.CutAt(last, result.has_own_keypoints ? newest : nullptr, gravity, result.mask);
  result.num_people = s.CountPeople(s.history[last].people);
  if (s.newest_keypoints_ns) {
    result.mask_age_s = SecondsBetween(*s.newest_keypoints_ns, frame.stamp_ns);
  }
  return result;
}

void HumanRemover::Reset() {
  const HumanRemovalConfig config = state_->config;
  state_ = std::make_unique<State>(config);
}

const std::vector<PersonSeeds>& HumanRemover::seeds() const { return state_->cutter.people(); }
const KeypointCounts& HumanRemover::counts() const { return state_->counts; }
const HumanRemovalConfig& HumanRemover::config() const { return state_->config; }

cv::Mat StaticDepth(const cv::Mat& depth_m, const cv::Mat& mask) {
  cv::Mat static_depth_m = depth_m.clone();
  static_depth_m.setTo(0, mask);
  return static_depth_m;
}

}  // namespace posefusion
