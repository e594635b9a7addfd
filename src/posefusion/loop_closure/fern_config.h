#pragma once

#include "posefusion/config/config.h"

namespace posefusion {

/// Randomised ferns over small RGB-D images (Glocker et al. 2015), and which images become
/// keyframes.
struct FernConfig {
  int num_ferns = 500;           ///< tests of colour and depth, each at a random pixel
  int seed = 1;                  ///< of places and thresholds
  int level = 3;                 ///< pyramid level of the small image: 80 x 60 of 640 x 480
  double min_known_share = 0.3;  ///< images with fewer ferns known in both are not compared
  double max_similarity = 0.8;   ///< an image is new if none stored is as similar as this
  int max_keyframes = 1500;      ///< then the one most similar to a new one makes room
};

template <class V>
void Describe(V& v, FernConfig& c) {
  v.Field("num_ferns", c.num_ferns, 1, 10000);
  v.Field("seed", c.seed, 0, 1'000'000'000);
  v.Field("level", c.level, 0, 3);
  v.Field("min_known_share", c.min_known_share, 0.01, 1.0);
  v.Field("max_similarity", c.max_similarity, 0.0, 1.0);
  v.Field("max_keyframes", c.max_keyframes, 1, 100000);
}

}  // namespace posefusion
