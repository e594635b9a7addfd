#pragma once

#include <string>

namespace posefusion {

/// Where SkeletonIngest gets keypoints from.
enum class KeypointOrigin { kNone, kFolder, kTopic };

/// Parameters of the SkeletonIngest nodelet.
struct SkeletonIngestConfig {
  KeypointOrigin source = KeypointOrigin::kNone;
  std::string folder;              ///< of OpenPose's JSON files, for source folder
  int subscriber_queue_size = 10;  ///< messages that may wait; older ones are dropped
  bool lossless = false;           ///< let everything wait instead (playing a bag, not a robot)
};

template <class V>
void Describe(V& v, SkeletonIngestConfig& c) {
  v.Choice("source", c.source, {"none", "folder", "topic"});
  v.Field("folder", c.folder);
  v.Field("subscriber_queue_size", c.subscriber_queue_size, 1, 1000);
  v.Field("lossless", c.lossless);
}

}  // namespace posefusion
