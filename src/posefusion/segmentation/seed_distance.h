#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
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
  SeedDistance() = default;
  explicit SeedDistance(const std::vector<BodyPoint>& seeds) {
    for (const BodyPoint& seed : seeds) Add(seed);
  }

  void Add(const BodyPoint& seed) {
    x_.push_back(seed.p_camera.x());
    y_.push_back(seed.p_camera.y());
    z_.push_back(seed.p_camera.z());
    weight_.push_back(1 / (seed.radius_share * seed.radius_share));
    low_ = low_.cwiseMin(seed.p_camera);
    high_ = high_.cwiseMax(seed.p_camera);
    max_share_ = std::max(max_share_, seed.radius_share);
  }

  /// Keeps the memory.
  void Clear() {
    for (auto* values : {&x_, &y_, &z_, &weight_}) values->clear();
    low_.setConstant(std::numeric_limits<float>::infinity());
    high_ = -low_;
    max_share_ = 0;
  }

  /// To the nearest seeds, metres squared; infinite without seeds.
  struct Squares {
    float distance = std::numeric_limits<float>::infinity();
    /// Of each seed divided by its share squared: a distance from a thin limb counts as longer.
    float in_shares = std::numeric_limits<float>::infinity();
  };

  Squares To(const Eigen::Vector3f& point) const {
    std::array<Squares, kLanes> best;
    const std::size_t rest = x_.size() - x_.size() % kLanes;
    for (std::size_t i = 0; i < rest; i += kLanes) {
      for (std::size_t l = 0; l < kLanes; ++l) Look(point, i + l, best[l]);
    }
    for (std::size_t i = rest; i < x_.size(); ++i) Look(point, i, best[0]);
    for (const Squares& lane : best) {
      best[0].distance = std::min(best[0].distance, lane.distance);
      best[0].in_shares = std::min(best[0].in_shares, lane.in_shares);
    }
    return best[0];
  }

  /// The first seed that is as near as To() says.
  std::size_t Nearest(const Eigen::Vector3f& point, float squared) const {
    std::size_t i = 0;
    while (i + 1 < x_.size() && SquareTo(point, i) != squared) ++i;
    return i;
  }

  bool IsWithinShare(const Eigen::Vector3f& point, float distance_m) const {
    const float reach_m = distance_m * max_share_;
    if ((point - low_).minCoeff() < -reach_m || (point - high_).maxCoeff() > reach_m) return false;
    return To(point).in_shares < distance_m * distance_m;
  }

 private:
  static constexpr std::size_t kLanes = 4;  ///< seeds are looked at so many at once

  float SquareTo(const Eigen::Vector3f& point, std::size_t i) const {
    const float dx = x_[i] - point.x();
    const float dy = y_[i] - point.y();
    const float dz = z_[i] - point.z();
    return dx * dx + dy * dy + dz * dz;
  }

  void Look(const Eigen::Vector3f& point, std::size_t i, Squares& best) const {
    const float squared = SquareTo(point, i);
    const float in_shares = squared * weight_[i];
    best.distance = squared < best.distance ? squared : best.distance;
    best.in_shares = in_shares < best.in_shares ? in_shares : best.in_shares;
  }

  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<float> weight_;
  Eigen::Vector3f low_ = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high_ = -low_;  ///< corners of the box around all of them
  float max_share_ = 0;
};

}  // namespace posefusion
