#include "posefusion/segmentation/person_tracks.h"

#include <algorithm>

namespace posefusion {

void PersonTracks::NoteKeypoints(double time_s) {
  newest_s_ = newest_s_ ? std::max(*newest_s_, time_s) : time_s;
}

std::optional<CellPerson> PersonTracks::Add(double time_s) {
  for (int number = kNobody + 1; number <= kMaxPersonNumber; ++number) {
    const auto person = static_cast<CellPerson>(number);
    if (tracks_.try_emplace(person, Track{time_s, time_s, false}).second) return person;
  }
  return std::nullopt;
}

void PersonTracks::Confirm(CellPerson person, double time_s, int num_certain_joints) {
  Track& track = tracks_.at(person);
  track.last_s = std::max(track.last_s, time_s);
  track.is_certain |= num_certain_joints >= config_.min_certain_joints;
}

bool PersonTracks::Holds(CellPerson person) const {
  const auto track = tracks_.find(person);
  if (track == tracks_.end() || !newest_s_) return false;
  const double seen_s = track->second.last_s - track->second.first_s;
  const bool is_trusted = seen_s >= config_.trusted_after_s;
  double hold_s = config_.min_hold_s;
  if (is_trusted) hold_s = std::min(config_.hold_per_seen * seen_s, config_.max_hold_s);
  if (track->second.is_certain) hold_s = std::max(hold_s, config_.certain_hold_s);
  return *newest_s_ - track->second.last_s <= hold_s;
}

}  // namespace posefusion
