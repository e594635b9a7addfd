#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace posefusion {

/// A point on a body, with how far the body reaches around it.
struct BodyPoint {
  Eigen::Vector3f p_camera;  ///< metres
  float radius_share = 1;    ///< of that of a trunk: limbs are thinner
};

/// Distances of points to the nearest of some points on bodies.
class SeedDistance {
 public:
  explicit SeedDistance(const std::vector<BodyPoint>& seeds) {
    for (const BodyPoint& seed : seeds) {
      x_.push_back(seed.p_camera.x());
      y_.push_back(seed.p_camera.y());
      z_.push_back(seed.p_camera.z());
      weight_.push_back(1 / (seed.radius_share * seed.radius_share));
    }
  }

  /// Metres squared, of each seed divided by its share squared: a distance from a thin limb counts
  /// as a longer one. Infinite without seeds.
  float SquaredInShares(const Eigen::Vector3f& point) const {
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const float squared = Squared(i, point) * weight_[i];
      best = squared < best ? squared : best;
    }
    return best;
  }

  /// Metres squared; infinite without seeds.
  float Squared(const Eigen::Vector3f& point) const {
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const float squared = Squared(i, point);
      best = squared < best ? squared : best;
    }
    return best;
  }

  bool IsWithinShare(const Eigen::Vector3f& point, float distance_m) const {
    return SquaredInShares(point) < distance_m * distance_m;
  }

 private:
  float Squared(std::size_t i, const Eigen::Vector3f& point) const {
    const float dx = x_[i] - point.x();
    const float dy = y_[i] - point.y();
    const float dz = z_[i] - point.z();
    return dx * dx + dy * dy + dz * dz;
  }

  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<float> weight_;
};

}  // namespace posefusion
