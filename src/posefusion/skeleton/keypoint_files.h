#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// What a folder of OpenPose's JSON files holds.
struct KeypointFiles {
  bool numbered = false;                      ///< by image, from 0; otherwise by stamp
  std::map<std::int64_t, std::string> paths;  ///< by number or by stamp in nanoseconds
  std::map<StampNs, StampNs> arrival_ns;      ///< by image stamp; absent = on time
  int num_unknown = 0;                        ///< .json files whose names say neither
};

/// Lists a folder: `<stamp>.json`, or `<stamp>_keypoints.json` as OpenPose names what it makes of
/// single images, or OpenPose's numbering of videos, `<name>_000000000012_keypoints.json` (twelve
/// digits); and arrival.txt with lines `stamp arrival_stamp`, if it is there.
/// @throws std::invalid_argument naming the folder when there is none or when it holds numbered
/// files beside stamped ones, or the line of arrival.txt that is malformed.
KeypointFiles ListKeypointFiles(const std::string& folder);

}  // namespace posefusion
