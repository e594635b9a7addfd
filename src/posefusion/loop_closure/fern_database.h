#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/loop_closure/fern_code.h"
#include "posefusion/loop_closure/fern_config.h"

namespace posefusion {

/// A view that is remembered.
struct FernKeyframe {
  int id = 0;  ///< counts up from 0, never used twice
  StampNs stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// A keyframe that looks like the image asked about.
struct FernMatch {
  FernKeyframe keyframe;
  double similarity = 0;  ///< share of the ferns known in both that are equal, 0..1
};

/// Remembers different views by their fern codes. Memory is bounded by max_keyframes. Not
/// thread-safe.
class FernDatabase {
 public:
  explicit FernDatabase(const FernConfig& config);

  /// Stores a view if it is unlike all stored ones and enough of it is known. True when stored.
  bool AddIfNew(StampNs stamp_ns, const FernCode& code, const Eigen::Isometry3d& T_map_camera);

  /// The at most `count` most similar keyframes of at least `min_similarity`, best first; equal
  /// ones by id. Empty when too little of the code is known.
  std::vector<FernMatch> Query(const FernCode& code, int count, double min_similarity) const;

  int size() const { return static_cast<int>(keyframes_.size()); }
  void Clear();

 private:
  /// Similarity with a stored view; below 0 where too few ferns are known in both.
  double Similarity(const FernCode& code, std::size_t index) const;
  bool IsKnown(const FernCode& code) const;

  FernConfig config_;
  std::vector<FernKeyframe> keyframes_;
  std::vector<std::uint8_t> codes_;  ///< of all keyframes, num_ferns each
  int next_id_ = 0;
  std::size_t last_similar_ = 0;  ///< the keyframe that the last image resembled
};

}  // namespace posefusion
