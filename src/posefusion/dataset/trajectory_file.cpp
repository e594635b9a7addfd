#include "posefusion/dataset/trajectory_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/text_lines.h"

namespace posefusion {
namespace {

constexpr std::size_t kNumColumns = 8;
constexpr double kMinQuaternionNorm = 1e-3;  ///< below there is no rotation to speak of

std::string FormatPose(const StampedPose& pose) {
  const Eigen::Vector3d t = pose.T_map_camera.translation();
  Eigen::Quaterniond q(pose.T_map_camera.linear());
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), "%s %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
                FormatStamp(pose.stamp_ns).c_str(), t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                q.w());
  return text.data();
}

double ParseFinite(const std::string& text, const std::string& line_name) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) {
    throw std::runtime_error(line_name + ": '" + text + "' is not a finite number");
  }
  return value;
}

StampedPose ParsePose(const TextLine& line, const std::string& name) {
  if (line.columns.size() != kNumColumns) {
    throw std::runtime_error(name + ": expected 'stamp tx ty tz qx qy qz qw', got " +
                             std::to_string(line.columns.size()) + " columns");
  }
  StampedPose pose;
  const auto stamp_ns = ParseStamp(line.columns.front());
  // Some programs print stamps with an exponent or more than nine decimals.
  pose.stamp_ns = stamp_ns ? *stamp_ns : StampFromSeconds(ParseFinite(line.columns.front(), name));
  std::array<double, kNumColumns> values{};
  for (std::size_t i = 1; i < kNumColumns; ++i) values[i] = ParseFinite(line.columns[i], name);
  const Eigen::Quaterniond q(values[7], values[4], values[5], values[6]);
  if (q.norm() < kMinQuaternionNorm) throw std::runtime_error(name + ": quaternion is zero");
  pose.T_map_camera.linear() = q.normalized().toRotationMatrix();
  pose.T_map_camera.translation() << values[1], values[2], values[3];
  return pose;
}

}  // namespace

void WriteTrajectory(const Trajectory& trajectory, const std::string& path) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) text += FormatPose(pose);
  WriteFileAtomically(path, text);
}

Trajectory ReadTrajectory(const std::string& path) {
  Trajectory trajectory;
  for (const TextLine& line : ReadTextLines(path)) {
    trajectory.push_back(ParsePose(line, LineName(path, line)));
  }
  if (trajectory.empty()) throw std::runtime_error(path + ": holds no poses");
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.stamp_ns < b.stamp_ns; });
  return trajectory;
}

}  // namespace posefusion
