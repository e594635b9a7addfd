#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/dataset/triangle_mesh.h"

namespace posefusion {

/// A thing that somebody moves once, and its surfaces where it rests before and after. Frame of the
/// ground truth, metres.
struct MovedSurfaces {
  std::string name;  ///< without blanks
  StampNs begin_ns = 0;
  StampNs end_ns = 0;
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< from the first place to the second
  TriangleMesh before;                                 ///< until begin_ns
  TriangleMesh after;                                  ///< from end_ns on
};

/// moved_objects.txt says what was moved during a run: a line
/// `start_stamp end_stamp name dx dy dz mesh_before mesh_after` for each thing (seconds, metres);
/// the meshes are PLY files, named from the folder of the text file on. "#" starts a comment.

/// Replaces moved_objects.txt of an existing folder and writes the meshes into its subfolder
/// moved_objects/. @throws std::runtime_error naming a file that cannot be written.
void WriteMovedObjects(const std::vector<MovedSurfaces>& objects, const std::string& folder);

/// Reads both. Lines without names of meshes give things without surfaces.
/// @throws std::runtime_error naming file and line for anything else, and an unreadable file.
std::vector<MovedSurfaces> ReadMovedObjects(const std::string& path);

}  // namespace posefusion
