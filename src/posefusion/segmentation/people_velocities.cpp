#include "posefusion/segmentation/people_velocities.h"

#include <algorithm>
#include <cstddef>

namespace posefusion {
namespace {

constexpr int kStep = 2;               ///< every other cell in both directions is looked at
constexpr std::size_t kMinCells = 10;  ///< of those, for a velocity
constexpr float kNewShare = 0.3F;      ///< of a frame in the smoothed velocity

}  // namespace

void VelocityMeter::Collect(const PeopleMotion& task) {
  for (Displacements& displacements : displacements_) {
    for (auto& values : displacements) values.clear();
  }
  for (int y = 0; y < task.now.height(); y += kStep) {
    const auto* moved = task.motion.ptr<cv::Vec2f>(y);
    for (int x = 0; x < task.now.width(); x += kStep) {
      const CellPerson person = task.people_now.person.at(x, y);
      if (!IsPerson(person)) continue;
      const Eigen::Vector2f place =
          Eigen::Vector2i(x, y).cast<float>() + Eigen::Vector2f(moved[x][0], moved[x][1]);
      const auto from = task.before.CellNear(place.cast<double>());
      if (!from || task.before.DepthAt(from->x, from->y) <= 0) continue;
      const Eigen::Vector3f displacement =
          task.T_before_now * task.now.PointAt(x, y) - task.before.PointAt(from->x, from->y);
      for (std::size_t i = 0; i < 3; ++i) {
        displacements_[person][i].push_back(displacement[static_cast<int>(i)]);
      }
    }
  }
}

/// Of each axis.
Eigen::Vector3f VelocityMeter::Median(Displacements& displacements) {
  Eigen::Vector3f median;
  for (std::size_t i = 0; i < 3; ++i) {
    auto& values = displacements[i];
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[static_cast<int>(i)] = *middle;
  }
  return median;
}

void VelocityMeter::Update(const PeopleMotion& task, PeopleVelocities& velocities) {
  Collect(task);
  const Eigen::Matrix3f R_now_before = task.T_before_now.linear().transpose();
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    auto& velocity = velocities[i];
    if (displacements_[i][0].size() >= kMinCells) {
      const Eigen::Vector3f now = Median(displacements_[i]) / static_cast<float>(task.interval_s);
      velocity = velocity ? Eigen::Vector3f(*velocity + kNewShare * (now - *velocity)) : now;
    }
    if (velocity) velocity = R_now_before * *velocity;
  }
}

}  // namespace posefusion
