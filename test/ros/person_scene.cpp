#include "test/ros/person_scene.h"

#include "test/support/rendered_source.h"

namespace posefusion {
namespace {

constexpr double kFront = 0.2;  // x of the person's front in the map
constexpr double kDepth = 0.25;
constexpr double kHalfWidth = 0.22;
constexpr double kTop = 0.7;
constexpr double kFloor = -1;

/// y of the person in the map.
double PlaceOf(int index) { return 0.35 - 0.012 * index; }

/// Joints on the front of the box: to the left of its middle and above the floor, metres.
struct PlacedJoint {
  CocoJoint joint;
  double left_m;
  double height_m;
};
constexpr PlacedJoint kPlaced[] = {
    {kNose, 0, 1.55},
    {kNeck, 0, 1.38},
    {kRightShoulder, -0.16, 1.36},
    {kLeftShoulder, 0.16, 1.36},
    {kRightElbow, -0.17, 1.1},
    {kLeftElbow, 0.17, 1.1},
    {kRightWrist, -0.17, 0.88},
    {kLeftWrist, 0.17, 0.88},
    {kRightHip, -0.1, 0.9},
    {kLeftHip, 0.1, 0.9},
    {kRightKnee, -0.1, 0.5},
    {kLeftKnee, 0.1, 0.5},
};

Skeleton JointsAt(double place, const CameraModel& camera, const Eigen::Isometry3d& T_camera_map) {
  Skeleton skeleton{};
  for (const PlacedJoint& placed : kPlaced) {
    const Eigen::Vector3d p_map(kFront, place + placed.left_m, kFloor + placed.height_m);
    const Eigen::Vector2d pixel = camera.Project(T_camera_map * p_map);
    const bool inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.width - 1 &&
                        pixel.y() <= camera.height - 1;
    if (!inside) continue;
    skeleton[placed.joint] = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), 0.8F};
  }
  return skeleton;
}

}  // namespace

PersonFrame SyntheticPerson(int index, StampNs start_ns) {
  const double place = PlaceOf(index);
  testing::RenderedRoom room = testing::RenderedRoom::Furnished();
  room.AddBox({{kFront, place - kHalfWidth, kFloor}, {kFront + kDepth, place + kHalfWidth, kTop}});
  const Eigen::Isometry3d T_map_camera = testing::SwayingPose(index);
  PersonFrame person;
  person.frame = room.Render(testing::SmallCamera(), T_map_camera,
                             start_ns + index * testing::kRenderedInterval);
  person.frame.depth_stamp_ns = person.frame.stamp_ns + kDepthLagNs;
  person.skeletons.stamp_ns = person.skeletons.arrival_ns = person.frame.stamp_ns;
  person.skeletons.people = {JointsAt(place, person.frame.camera, T_map_camera.inverse())};
  return person;
}

}  // namespace posefusion
