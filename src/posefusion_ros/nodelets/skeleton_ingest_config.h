#pragma once

#include <string>

#include "posefusion/skeleton/pose_network_config.h"

namespace posefusion {

/// Where SkeletonIngest gets keypoints from.
enum class KeypointOrigin { kNone, kFolder, kTopic, kNetwork };

/// Parameters of the SkeletonIngest nodelet.
struct SkeletonIngestConfig {
  KeypointOrigin source = KeypointOrigin::kNone;
  std::string folder;              ///< of OpenPose's JSON files, for source folder
  PoseNetworkConfig network;       ///< for source network
  int subscriber_queue_size = 10;  ///< messages that may wait; older ones are dropped
  bool lossless = false;           ///< let everything wait instead (playing a bag, not a robot)
};

template <class V>
void Describe(V& v, SkeletonIngestConfig& c) {
  v.Choice("source", c.source, {"none", "folder", "topic", "network"});
  v.Field("folder", c.folder);
  v.Group("network", c.network);
  v.Field("subscriber_queue_size", c.subscriber_queue_size, 1, 1000);
  v.Field("lossless", c.lossless);
}

}  // namespace posefusion
