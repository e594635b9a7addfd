#include "posefusion/simulation/robot_files.h"

#include <array>
#include <cstdio>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {
namespace {

std::string ImuText(const RobotRecord& record) {
  std::string text = "# stamp gx gy gz ax ay az (rad/s, m/s2; axes of " + record.imu_frame + ")\n";
  for (const ImuSample& sample : record.imu) {
    const Eigen::Vector3d& w = sample.angular_velocity_rad_s;
    const Eigen::Vector3d& a = sample.acceleration_m_s2;
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(), " %.7f %.7f %.7f %.6f %.6f %.6f\n", w.x(), w.y(), w.z(),
                  a.x(), a.y(), a.z());
    text += FormatStamp(SimulationStamp(sample.time_s)) + line.data();
  }
  return text;
}

std::string JointText(const RobotRecord& record) {
  std::string text = "# stamp";
  for (const std::string& name : JointNames()) text += " " + name;
  text += "\n";
  for (const RobotSample& sample : record.samples) {
    text += FormatStamp(sample.stamp_ns);
    for (const double angle : JointAngles(sample.neck)) {
      std::array<char, 32> number{};
      std::snprintf(number.data(), number.size(), " %.7f", angle);
      text += number.data();
    }
    text += "\n";
  }
  return text;
}

std::string TransformLine(StampNs stamp_ns, const std::string& parent, const std::string& child,
                          const Eigen::Isometry3d& T) {
  const Eigen::Vector3d t = T.translation();
  const Eigen::Quaterniond q(T.linear());
  std::array<char, 160> numbers{};
  std::snprintf(numbers.data(), numbers.size(), " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", t.x(),
                t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  return FormatStamp(stamp_ns) + " " + parent + " " + child + numbers.data();
}

std::string TransformText(const RobotRecord& record) {
  std::string text = "# stamp parent child tx ty tz qx qy qz qw\n";
  for (const RobotSample& sample : record.samples) {
    const bool first = &sample == &record.samples.front();
    text += TransformLine(sample.stamp_ns, kOdomFrame, kRootLink, sample.T_odom_body);
    for (const LinkPose& link : HeadChain(sample.neck)) {
      if (first || link.moves) {
        text += TransformLine(sample.stamp_ns, link.parent, link.name, link.T_parent_link);
      }
    }
  }
  return text;
}

Trajectory OdometryTrajectory(const RobotRecord& record) {
  Trajectory trajectory;
  for (const RobotSample& sample : record.samples) {
    trajectory.push_back({sample.stamp_ns, sample.T_odom_body});
  }
  return trajectory;
}

}  // namespace

void WriteRobotFiles(const RobotRecord& record, const std::string& folder) {
  WriteTrajectory(record.groundtruth, folder + "/groundtruth.txt");
  WriteFileAtomically(folder + "/imu.txt", ImuText(record));
  if (record.samples.empty()) return;
  WriteTrajectory(record.body_groundtruth, folder + "/groundtruth_body.txt");
  WriteTrajectory(OdometryTrajectory(record), folder + "/odometry.txt");
  WriteTrajectory(CameraOdometry(record), folder + "/odometry_camera.txt");
  WriteFileAtomically(folder + "/joint_states.txt", JointText(record));
  WriteFileAtomically(folder + "/tf.txt", TransformText(record));
}

}  // namespace posefusion
