#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "posefusion/loop_closure/coarse_aligner.h"
#include "posefusion/loop_closure/fern_database.h"
#include "posefusion/loop_closure/fern_encoder.h"
#include "posefusion/loop_closure/relocalisation_config.h"
#include "posefusion/loop_closure/verification.h"
#include "posefusion/tracking/tracker.h"

namespace posefusion {

/// Draws what the map predicts from a pose. The views are valid until the next call.
struct MapViews {
  using Draw = std::function<const ModelView&(const Eigen::Isometry3d& T_map_camera)>;
  Draw small;   ///< in the resolution of the ferns
  Draw normal;  ///< in the resolution that tracking uses
};

/// Remembers views while tracking goes well and finds the camera by them when it has failed.
///
/// A lost frame is compared with the keyframes; from the poses of the most similar ones it is
/// aligned coarsely and with wide reach, from the best of these as in tracking. A pose that
/// stands the tracker's judgement and stricter limits is believed only after the next frames have
/// been found beside it in the same way: a wrong pose is worse than none. Not thread-safe.
class Relocaliser {
 public:
  Relocaliser(const RelocalisationConfig& config, const TrackingConfig& tracking,
              const PyramidConfig& pyramid, const DepthNoiseConfig& noise);

  /// A frame that was tracked: it may become a keyframe. Ends a search.
  void NoteTracked(const FramePyramid& frame, const TrackingResult& result);

  /// A frame that was not tracked. Gives its pose once that has been confirmed, with the tracker's
  /// state as it was. A call costs at most candidates_per_frame small views and a normal one.
  std::optional<TrackingResult> Find(const FramePyramid& frame, const MapViews& views,
                                     const ParallelRunner& parallel, Tracker& tracker);

  int num_keyframes() const { return database_.size(); }

 private:
  /// A pose that waits for confirmation.
  struct Proposal {
    StampNs stamp_ns;
    Eigen::Isometry3d T_map_camera;
    int confirmations = 0;
    int misses = 0;  ///< frames that did not confirm it
  };

  std::vector<FernMatch> NextCandidates(const FramePyramid& frame);
  std::optional<Eigen::Isometry3d> BestCandidate(const FramePyramid& frame, const MapViews& views,
                                                 const ParallelRunner& parallel);
  std::optional<TrackingResult> Propose(const FramePyramid& frame, const MapViews& views,
                                        const ParallelRunner& parallel, Tracker& tracker);
  std::optional<TrackingResult> Confirm(const FramePyramid& frame, const Proposal& proposal,
                                        const MapViews& views, const ParallelRunner& parallel,
                                        Tracker& tracker) const;
  bool IsCredible(const FramePyramid& frame, const ModelView& view,
                  const TrackingResult& result) const;
  Agreement Compare(const FramePyramid& frame, const ModelView& view,
                    const Eigen::Isometry3d& T_map_camera) const;
  bool IsPlausibleStep(const Proposal& from, StampNs stamp_ns,
                       const Eigen::Isometry3d& T_map_camera) const;

  RelocalisationConfig config_;
  TrackingConfig tracking_;
  DepthNoiseConfig noise_;
  FernEncoder encoder_;
  FernDatabase database_;
  CoarseAligner coarse_aligner_;
  FernCode code_;
  int num_good_ = 0;              ///< frames in a row
  std::map<int, int> num_tries_;  ///< of keyframes by id, since the camera was lost
  std::optional<Proposal> proposal_;
};

}  // namespace posefusion
