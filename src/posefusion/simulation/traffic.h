#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "posefusion/simulation/world.h"

namespace posefusion {

/// Who is where on the floor at what time: the camera and the people planned so far. Map frame,
/// metres, seconds.
class Traffic {
 public:
  explicit Traffic(const WorldConfig& config);

  /// Adds somebody whose place is known for every time.
  void AddPerson(const std::function<Eigen::Vector2d(double)>& place_at);

  /// True when the camera comes nearer than `to_camera_m` to the place, or others too near, at any
  /// time of the interval; and for longer stays at places that are to be kept clear.
  bool IsTaken(const Eigen::Vector2d& place, double from_s, double to_s, double to_camera_m) const;

  /// The same along a way that is walked in the given time.
  bool IsTaken(const std::vector<Eigen::Vector2d>& way, double from_s, double duration_s,
               double to_camera_m) const;

 private:
  /// Places at multiples of a tenth of a second; the last one holds from then on.
  using Track = std::vector<Eigen::Vector2d>;
  Track Record(const std::function<Eigen::Vector2d(double)>& place_at) const;

  const WorldConfig& config_;
  Track camera_;  ///< empty when unknown
  std::vector<Track> people_;
};

}  // namespace posefusion
