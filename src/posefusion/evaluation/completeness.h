#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/dataset/triangle_mesh.h"
#include "posefusion/evaluation/disc_index.h"
#include "posefusion/evaluation/mesh_index.h"
#include "posefusion/image/camera_model.h"

namespace posefusion {

/// Points spread evenly over a mesh: each stands for 1 / samples_per_m2 of its area.
std::vector<Eigen::Vector3f> SampleSurface(const TriangleMesh& mesh, double samples_per_m2,
                                           int seed);

/// What a camera has seen of a mesh along its way.
struct Views {
  CameraModel camera;  ///< its distortion is ignored
  std::vector<Eigen::Isometry3d> T_map_camera;
  double max_distance_m = 3;
};

/// The points that lie in some view's image, within its distance, with nothing of the mesh before
/// them.
std::vector<Eigen::Vector3f> SeenPoints(const std::vector<Eigen::Vector3f>& points,
                                        const MeshIndex& mesh, const Views& views,
                                        const ParallelRunner& runner);

/// How many of the points have a disc whose center is within `distance_m`, or that they are over
/// within that distance.
int CountCovered(const std::vector<Eigen::Vector3f>& points, const std::vector<Disc>& discs,
                 double distance_m, const ParallelRunner& runner);

}  // namespace posefusion
