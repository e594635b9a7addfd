#pragma once

#include <map>
#include <optional>

#include "posefusion/segmentation/carried_people.h"

namespace posefusion {

/// How long somebody is believed in whom newer keypoints do not show.
struct PersonHoldConfig {
  double min_hold_s = 0.1;       ///< somebody seen for a shorter time than ...
  double trusted_after_s = 0.3;  ///< ... this; from then on ...
  double hold_per_seen = 1.5;    ///< ... so many seconds for each second of being seen
  double max_hold_s = 2.0;       ///< somebody seen for long
  double certain_hold_s = 0.45;  ///< at least so long whoever showed ...
  int min_certain_joints = 4;    ///< ... so many certain joints at once, even for a moment
  /// What a cut covers moves the evidence of its cells towards 1 by this share ...
  double gain = 0.35;           ///< ... so close to a seed ...
  double gain_radius_m = 0.15;  ///< ... in the image, at the seed's depth,
  double far_gain = 0.2;        ///< ... and farther away.
  /// What the cuts leave out moves the evidence of their people's cells towards -1 by this share
  /// ...
  double loss = 0.2;            ///< ... so close to a seed ...
  double loss_radius_m = 0.35;  ///< ... in the image, at the seed's depth,
  double far_loss = 0.05;       ///< ... farther away: its joints may have been missed,
  double surface_loss = 0.4;    ///< ... and on a large plane.
  double max_mask_age_s = 2.0;  ///< without any newer keypoints nobody is believed in for longer
  int min_cells = 4;            ///< somebody of fewer cells is forgotten
};

template <class V>
void Describe(V& v, PersonHoldConfig& c) {
  v.Field("min_hold_s", c.min_hold_s, 0.0, 100.0);
  v.Field("trusted_after_s", c.trusted_after_s, 0.0, 100.0);
  v.Field("hold_per_seen", c.hold_per_seen, 0.0, 100.0);
  v.Field("max_hold_s", c.max_hold_s, 0.0, 100.0);
  v.Field("certain_hold_s", c.certain_hold_s, 0.0, 100.0);
  v.Field("min_certain_joints", c.min_certain_joints, 1, 19);
  v.Field("gain", c.gain, 0.0, 1.0);
  v.Field("loss", c.loss, 0.0, 1.0);
  v.Field("far_gain", c.far_gain, 0.0, 1.0);
  v.Field("gain_radius_m", c.gain_radius_m, 0.0, 10.0);
  v.Field("far_loss", c.far_loss, 0.0, 1.0);
  v.Field("surface_loss", c.surface_loss, 0.0, 1.0);
  v.Field("loss_radius_m", c.loss_radius_m, 0.0, 10.0);
  v.Field("max_mask_age_s", c.max_mask_age_s, 0.0, 1000.0);
  v.Field("min_cells", c.min_cells, 1, 10000);
}

/// Who is known, and since when. A false person, seen for a moment with few or uncertain joints, is
/// forgotten soon; somebody seen for long whom the network misses for a while is not. Times are
/// seconds since any origin.
class PersonTracks {
 public:
  explicit PersonTracks(const PersonHoldConfig& config) : config_(config) {}

  /// Keypoints of that time have been used: from now on those they do not show count as missed.
  void NoteKeypoints(double time_s);

  /// A number for somebody new; empty when all numbers are in use.
  std::optional<CellPerson> Add(double time_s);
  /// `num_certain_joints` of the keypoints that cover the person.
  void Confirm(CellPerson person, double time_s, int num_certain_joints);
  void Forget(CellPerson person) { tracks_.erase(person); }
  void Clear() { tracks_.clear(); }

  /// Whether somebody is still believed in.
  bool Holds(CellPerson person) const;

  /// When keypoints covered the person last. @throws std::out_of_range for an unknown one.
  double LastConfirmed(CellPerson person) const { return tracks_.at(person).last_s; }

  const PersonHoldConfig& config() const { return config_; }

  /// Time of the newest keypoints used so far.
  std::optional<double> newest_keypoints_s() const { return newest_s_; }

 private:
  struct Track {
    double first_s = 0;
    double last_s = 0;
    bool is_certain = false;
  };

  PersonHoldConfig config_;
  std::map<CellPerson, Track> tracks_;
  std::optional<double> newest_s_;
};

}  // namespace posefusion
