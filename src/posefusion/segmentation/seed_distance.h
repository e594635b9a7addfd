#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace posefusion {

/// Distances of points to the nearest of some seeds.
class SeedDistance {
 public:
  explicit SeedDistance(const std::vector<Eigen::Vector3f>& seeds) {
    for (const Eigen::Vector3f& seed : seeds) {
      x_.push_back(seed.x());
      y_.push_back(seed.y());
      z_.push_back(seed.z());
    }
  }

  /// Metres squared; infinite without seeds.
  float Squared(const Eigen::Vector3f& point) const {
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const float dx = x_[i] - point.x();
      const float dy = y_[i] - point.y();
      const float dz = z_[i] - point.z();
      const float squared = dx * dx + dy * dy + dz * dz;
      best = squared < best ? squared : best;
    }
    return best;
  }

  bool IsWithin(const Eigen::Vector3f& point, float distance_m) const {
    return Squared(point) < distance_m * distance_m;
  }

 private:
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
};

}  // namespace posefusion
