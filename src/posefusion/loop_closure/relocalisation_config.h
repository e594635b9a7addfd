#pragma once

#include "posefusion/loop_closure/fern_config.h"

namespace posefusion {

/// Finding the camera again after tracking has failed.
struct RelocalisationConfig {
  bool enabled = true;
  FernConfig ferns;
  int settle_frames = 5;         ///< so many good frames in a row before one is a keyframe
  int num_candidates = 8;        ///< keyframes most similar to the frame that are tried ...
  int candidates_per_frame = 2;  ///< ... so many with each lost frame: the first and others in turn
  double min_similarity = 0.3;   ///< less similar keyframes are not
  double reach_m = 0.5;          ///< first alignment: correspondences this far apart
  double min_overlap = 0.35;     ///< share of the frame that the map knows at a pose found
  double min_depth_agreement = 0.75;     ///< share of that where the depths agree ...
  double min_intensity_agreement = 0.9;  ///< ... and of these, where the intensities do, too
  double min_correlation = 0.9;          ///< of these intensities
  double max_sigma_m = 0.01;             ///< a pose more uncertain than this is not believed
  int confirmations = 2;        ///< so many following frames must agree with a pose found ...
  double max_spread_m = 0.01;   ///< ... and lead to it, so closely, from two sides of it
  int fusion_delay_frames = 2;  ///< so many tracked frames afterwards are not fused
};

template <class V>
void Describe(V& v, RelocalisationConfig& c) {
  v.Field("enabled", c.enabled);
  v.Group("ferns", c.ferns);
  v.Field("settle_frames", c.settle_frames, 1, 1000);
  v.Field("num_candidates", c.num_candidates, 1, 100);
  v.Field("candidates_per_frame", c.candidates_per_frame, 1, 100);
  v.Field("min_similarity", c.min_similarity, 0.0, 1.0);
  v.Field("reach_m", c.reach_m, 0.01, 2.0);
  v.Field("min_overlap", c.min_overlap, 0.01, 1.0);
  v.Field("min_depth_agreement", c.min_depth_agreement, 0.0, 1.0);
  v.Field("min_intensity_agreement", c.min_intensity_agreement, 0.0, 1.0);
  v.Field("min_correlation", c.min_correlation, -1.0, 1.0);
  v.Field("max_sigma_m", c.max_sigma_m, 1e-5, 10.0);
  v.Field("confirmations", c.confirmations, 1, 100);
  v.Field("max_spread_m", c.max_spread_m, 1e-6, 1.0);
  v.Field("fusion_delay_frames", c.fusion_delay_frames, 0, 1000);
}

}  // namespace posefusion
