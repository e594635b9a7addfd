#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/person_tracks.h"

namespace posefusion {

/// Cells of somebody with less evidence are decided anew where no keypoints cover the person.
constexpr float kFirstEvidence = 0.3F;

/// Evidence for or against a cell on which no keypoints have spoken yet, only its neighbours.
constexpr float kWeakEvidence = 0.1F;

/// Cells that a cut gave to one person.
struct PersonCut {
  CellPerson owner = kNobody;
  bool is_new = false;         ///< nobody knew the owner before
  cv::Mat cells;               ///< CV_8UC1 of the cells' size, 255 = the person
  float trunk = 1;             ///< share of the joints of the trunk that were found
  int num_certain_joints = 0;  ///< that it rests on
};

/// Far from all seeds a cut knows little of who is person; near them it knows what is not person,
/// at them also what is; on them there is nothing but person.
constexpr std::uint8_t kFarFromSeeds = 0;
constexpr std::uint8_t kNearSeeds = 1;
constexpr std::uint8_t kAtSeeds = 2;
constexpr std::uint8_t kOnSeeds = 3;

/// What keypoints of one frame say of its cells. Images are CV_8UC1 of the cells' size.
struct KeypointCuts {
  std::vector<PersonCut> cuts;
  cv::Mat near_seeds;  ///< kFarFromSeeds, kNearSeeds, kAtSeeds or kOnSeeds
  cv::Mat surfaces;    ///< not 0: on a large plane
};

/// Whether a cell is taken for background only because its neighbours are.
bool IsWeakBackground(const CellPeople& people, int x, int y);

/// Who each cut made from keypoints is: the person of `people` that it shares most with, or
/// somebody new, whom `tracks` then knows. Empty cuts are nobody's. Sets owner and is_new.
void RecognisePeople(const CellPeople& people, double time_s, PersonTracks& tracks,
                     std::vector<PersonCut>& cuts);

/// What is known of a frame's cells, given what was carried into it (`people`), what was cut out
/// with keypoints of this very frame (`seen`, null when there were none) and with carried cells
/// (`carried`, people whom those keypoints do not show).
///
/// Evidence is smoothed: a part of somebody known that one cut adds or leaves out changes nothing
/// yet; what it leaves out far from all joints that were found changes hardly anything. Somebody
/// new counts at once.
void UpdatePeople(const KeypointCuts* seen, const std::vector<PersonCut>& carried,
                  const CellGrid& cells, double time_s, const PersonTracks& tracks,
                  CellPeople& people);

/// Cells of people who are not believed in any more become unknown.
void ReleasePeople(const PersonTracks& tracks, CellPeople& people);

/// Number of cells of everybody, by person.
std::vector<int> CountCells(const CellPeople& people);

/// `mask` becomes CV_8UC1 of the cells' size, 255 = anybody with evidence of at least
/// kFirstEvidence.
void MarkKnown(const CellPeople& people, cv::Mat& mask);

/// `mask` becomes CV_8UC1 of the cells' size, 255 = anybody.
void MarkPeople(const CellPeople& people, cv::Mat& mask);

}  // namespace posefusion
