#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// A body part as all points within a radius of a line, frame of the ground truth.
struct PersonCapsule {
  int person = 0;
  int part = 0;  ///< any number that tells the parts of a person apart
  Eigen::Vector3f begin_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f end_m = Eigen::Vector3f::Zero();
  float radius_m = 0;
};

/// Where people were at a moment.
struct PeopleAtStamp {
  StampNs stamp_ns = 0;
  std::vector<PersonCapsule> capsules;
};

/// people_capsules.txt says where people were, for telling the ghosts that they leave in a map: a
/// line `stamp person part x0 y0 z0 x1 y1 z1 radius` for each part at each frame (seconds, metres),
/// in the order of the stamps; "#" starts a comment.

/// Replaces the file at once. @throws std::runtime_error naming a file that cannot be written.
void WritePeople(const std::vector<PeopleAtStamp>& people, const std::string& path);

/// Reads that file; moments come in the order of stamps.
/// @throws std::runtime_error naming file and line for anything else, and an unreadable file.
std::vector<PeopleAtStamp> ReadPeople(const std::string& path);

}  // namespace posefusion
