#include "posefusion/segmentation/people_memory.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace posefusion {
namespace {

/// A cut is of somebody known when it shares this much with them ...
constexpr double kSharedOfCut = 0.25;
/// ... or holds this much of them.
constexpr double kSharedOfPerson = 0.5;

constexpr std::size_t kNumNumbers = 256;

template <class Body>
void ForEachCell(const CellPeople& people, const Body& body) {
  for (int y = 0; y < people.person.height(); ++y) {
    for (int x = 0; x < people.person.width(); ++x) body(x, y);
  }
}

/// Number of the person of `people` whom the cut shows; kNobody when nobody known.
CellPerson KnownPersonIn(const cv::Mat& cut, int cut_size, const CellPeople& people,
                         const std::vector<int>& known) {
  std::vector<int> shared(kNumNumbers, 0);
  ForEachCell(people, [&](int x, int y) {
    const CellPerson person = people.person.at(x, y);
    if (cut.at<std::uint8_t>(y, x) != 0 && IsPerson(person)) ++shared[person];
  });
  const auto best = std::max_element(shared.begin(), shared.end());
  const auto number = static_cast<std::size_t>(best - shared.begin());
  const bool is_known =
      *best > 0 && (*best >= kSharedOfCut * cut_size || *best >= kSharedOfPerson * known[number]);
  return is_known ? static_cast<CellPerson>(number) : kNobody;
}

bool IsWeakPerson(const CellPeople& people, int x, int y) {
  return IsPerson(people.person.at(x, y)) && people.evidence.at(x, y) < kFirstEvidence;
}

bool IsCarried(const std::vector<PersonCut>& carried, CellPerson person) {
  return std::any_of(carried.begin(), carried.end(),
                     [&](const PersonCut& cut) { return cut.owner == person; });
}

/// Share of the way to 1 that evidence goes for a cell that a cut covers.
float GainAt(const KeypointCuts& seen, const PersonHoldConfig& hold, int x, int y) {
  const bool is_at_seed = seen.near_seeds.at<std::uint8_t>(y, x) >= kAtSeeds;
  return static_cast<float>(is_at_seed ? hold.gain : hold.far_gain);
}

/// How much of the trunk the cuts of somebody rest on: where it was not found, they do not say that
/// it is not there.
float TrunkOf(const std::vector<PersonCut>& cuts, CellPerson person) {
  float trunk = 0;
  bool is_cut = false;
  for (const PersonCut& cut : cuts) {
    if (cut.owner != person) continue;
    is_cut = true;
    trunk = std::max(trunk, cut.trunk);
  }
  return is_cut ? trunk : 1;
}

/// Share of the way to -1 that evidence goes for a cell that the cuts leave out.
float LossAt(const KeypointCuts& seen, const PersonHoldConfig& hold, CellPerson person, int x,
             int y) {
  if (seen.surfaces.at<std::uint8_t>(y, x) != 0) return static_cast<float>(hold.surface_loss);
  const float trunk = TrunkOf(seen.cuts, person);
  const bool is_near = seen.near_seeds.at<std::uint8_t>(y, x) != kFarFromSeeds;
  return static_cast<float>(is_near ? hold.loss : hold.far_loss) * trunk;
}

const PersonCut* CutAt(const std::vector<PersonCut>& cuts, int x, int y) {
  const auto holds = [&](const PersonCut& cut) {
    return cut.owner != kNobody && cut.cells.at<std::uint8_t>(y, x) != 0;
  };
  const auto cut = std::find_if(cuts.begin(), cuts.end(), holds);
  return cut == cuts.end() ? nullptr : &*cut;
}

}  // namespace

bool IsWeakBackground(const CellPeople& people, int x, int y) {
  return people.person.at(x, y) == kNobody && people.evidence.at(x, y) >= -kWeakEvidence;
}

void RecognisePeople(const CellPeople& people, double time_s, PersonTracks& tracks,
                     std::vector<PersonCut>& cuts) {
  const std::vector<int> known = CountCells(people);
  for (PersonCut& cut : cuts) {
    const int size = cv::countNonZero(cut.cells);
    cut.owner = size > 0 ? KnownPersonIn(cut.cells, size, people, known) : kNobody;
    cut.is_new = size > 0 && cut.owner == kNobody;
    if (cut.is_new) cut.owner = tracks.Add(time_s).value_or(kNobody);
    if (cut.owner != kNobody) tracks.Confirm(cut.owner, time_s, cut.num_certain_joints);
  }
}

void UpdatePeople(const KeypointCuts* seen, const std::vector<PersonCut>& carried,
                  const CellGrid& cells, double time_s, const PersonTracks& tracks,
                  CellPeople& people) {
  ForEachCell(people, [&](int x, int y) {
    CellPerson& person = people.person.at(x, y);
    float& evidence = people.evidence.at(x, y);
    if (cells.DepthAt(x, y) <= 0) {
      person = kUnknownCell;
      return;
    }
    const PersonCut* by_keypoints = seen != nullptr ? CutAt(seen->cuts, x, y) : nullptr;
    if (IsWeakPerson(people, x, y) && by_keypoints == nullptr && IsCarried(carried, person)) {
      person = kUnknownCell;
    }
    const bool is_weak = IsWeakBackground(people, x, y);
    const PersonCut* cut = by_keypoints;
    if (cut == nullptr && (is_weak || person == kUnknownCell)) cut = CutAt(carried, x, y);
    if (person == kUnknownCell || (is_weak && cut != nullptr)) {
      person = cut != nullptr ? cut->owner : kNobody;
      evidence = by_keypoints != nullptr ? kFirstEvidence
                                         : (cut != nullptr ? kWeakEvidence : -kWeakEvidence);
    } else if (by_keypoints != nullptr) {
      evidence = by_keypoints->is_new
                     ? kFirstEvidence
                     : evidence + GainAt(*seen, tracks.config(), x, y) * (1 - evidence);
      if (evidence > 0) person = by_keypoints->owner;
    } else if (seen != nullptr && (person == kNobody || tracks.LastConfirmed(person) == time_s)) {
      evidence -= LossAt(*seen, tracks.config(), person, x, y) * (1 + evidence);
      if (evidence <= 0) person = kNobody;
    }
  });
}

void ReleasePeople(const PersonTracks& tracks, CellPeople& people) {
  ForEachCell(people, [&](int x, int y) {
    CellPerson& person = people.person.at(x, y);
    if (IsPerson(person) && !tracks.Holds(person)) person = kUnknownCell;
  });
}

std::vector<int> CountCells(const CellPeople& people) {
  std::vector<int> counts(kNumNumbers, 0);
  ForEachCell(people, [&](int x, int y) { ++counts[people.person.at(x, y)]; });
  return counts;
}

void MarkKnown(const CellPeople& people, cv::Mat& mask) {
  mask.create(people.person.height(), people.person.width(), CV_8UC1);
  ForEachCell(people, [&](int x, int y) {
    const bool is_known = IsPerson(people.person.at(x, y)) && !IsWeakPerson(people, x, y);
    mask.at<std::uint8_t>(y, x) = is_known ? 255 : 0;
  });
}

void MarkPeople(const CellPeople& people, cv::Mat& mask) {
  mask.create(people.person.height(), people.person.width(), CV_8UC1);
  ForEachCell(people, [&](int x, int y) {
    mask.at<std::uint8_t>(y, x) = IsPerson(people.person.at(x, y)) ? 255 : 0;
  });
}

}  // namespace posefusion
