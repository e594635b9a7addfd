#include "posefusion/simulation/traffic.h"

#include <algorithm>

#include "posefusion/simulation/person_timeline.h"

namespace posefusion {
namespace {

using Eigen::Vector2d;

constexpr double kStep_s = 0.1;
constexpr double kBeyond_s = 40;    // people may end what they do after the run
constexpr double kToOthers = 0.55;  // metres between two people
constexpr double kLongStay_s = 2;

const Vector2d& At(const std::vector<Vector2d>& track, double time_s) {
  const auto index = static_cast<std::size_t>(std::max(time_s, 0.0) / kStep_s + 0.5);
  return track[std::min(index, track.size() - 1)];
}

}  // namespace

Traffic::Traffic(const WorldConfig& config) : config_(config) {
  if (!config.head) return;
  camera_ = Record([&](double time_s) -> Vector2d {
    return config.head->T_map_camera(time_s).translation().head<2>();
  });
}

Traffic::Track Traffic::Record(const std::function<Vector2d(double)>& place_at) const {
  Track track;
  const auto count = static_cast<int>((config_.seconds + kBeyond_s) / kStep_s);
  for (int i = 0; i < count; ++i) track.push_back(place_at(i * kStep_s));
  return track;
}

void Traffic::AddPerson(const std::function<Vector2d(double)>& place_at) {
  people_.push_back(Record(place_at));
}

bool Traffic::IsTaken(const Vector2d& place, double from_s, double to_s, double to_camera_m) const {
  for (double t = from_s; t <= to_s; t += 2 * kStep_s) {
    if (!camera_.empty() && (At(camera_, t) - place).norm() < to_camera_m) return true;
    for (const Track& other : people_) {
      if ((At(other, t) - place).norm() < kToOthers) return true;
    }
  }
  if (to_s - from_s < kLongStay_s) return false;
  return std::any_of(config_.keep_clear.begin(), config_.keep_clear.end(),
                     [&](const Vector2d& p) { return (p - place).norm() < to_camera_m; });
}

bool Traffic::IsTaken(const std::vector<Vector2d>& way, double from_s, double duration_s,
                      double to_camera_m) const {
  const double length = LengthOf(way);
  for (double t = 0.4; t <= duration_s; t += kStep_s) {
    const Vector2d at = PointAlong(way, length * WalkedShare(t / duration_s, duration_s));
    if (IsTaken(at, from_s + t, from_s + t, to_camera_m)) return true;
  }
  return false;
}

}  // namespace posefusion
