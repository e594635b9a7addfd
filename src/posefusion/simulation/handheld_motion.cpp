#include "posefusion/simulation/handheld_motion.h"

#include <algorithm>
#include <cmath>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/indexed_random.h"

namespace posefusion {
namespace {

constexpr int kSweepStream = 101;
constexpr int kTremorStream = 110;
constexpr double kMinSweepS = 0.4;
constexpr double kHaltS = 0.25;

// Where the camera is held and what it looks at: the near end of the table.
const Eigen::Vector3d kHeldAt(-1.85, 0.0, 1.42);
const Eigen::Vector3d kTarget(0.0, 0.0, 0.9);
const Eigen::Vector3d kSphereCentre(-0.8, 0.0, 0.95);
constexpr double kSphereRadius = 1.15;

/// Random values of one sequence, one after the other.
class Dice {
 public:
  explicit Dice(int seed) : random_(seed, kSweepStream) {}
  double Uniform(double low, double high) { return random_.Uniform(next_++, low, high); }
  bool Chance(double probability) { return random_.Uniform(next_++) < probability; }

 private:
  IndexedRandom random_;
  int next_ = 0;
};

/// Sweeps along x, y and z in turn, there and back. Values: translation in camera axes.
SweepSequence XyzSweeps(int seed, double seconds) {
  const Eigen::Vector3d amplitude(0.42, 0.40, 0.38);
  Dice dice(seed);
  SweepSequence sweeps(Vector6d::Zero());
  for (int axis = 0; sweeps.duration_s() < seconds; axis = (axis + 1) % 3) {
    for (const double side : {1.0, -1.0, 0.0}) {
      Vector6d point = Vector6d::Zero();
      point[axis] = side * amplitude[axis] * dice.Uniform(0.85, 1.15);
      point[(axis + 1) % 3] = dice.Uniform(-0.04, 0.04);
      for (int i = 3; i < 6; ++i) point[i] = dice.Uniform(-0.23, 0.23);
      const double length = (point - sweeps.last()).head<3>().norm();
      sweeps.Append(point, std::max(kMinSweepS, length / dice.Uniform(0.165, 0.28)));
    }
  }
  return sweeps;
}

/// Turns about the camera's axes in turn; now and then the holder takes a step aside.
SweepSequence RpySweeps(int seed, double seconds) {
  const Eigen::Vector3d amplitude(0.38, 0.48, 0.50);
  Dice dice(seed);
  SweepSequence sweeps(Vector6d::Zero());
  for (int i = 0; sweeps.duration_s() < seconds; ++i) {
    const int axis = (i + 2) % 3;
    for (const double side : {1.0, -1.0, 1.0, 0.0}) {
      Vector6d point = Vector6d::Zero();
      point[3 + axis] = side * amplitude[axis] * dice.Uniform(0.85, 1.15);
      const double reach = dice.Chance(0.15) ? 0.32 : 0.028;
      point[0] = dice.Uniform(-1, 1) > 0 ? reach : -reach;
      point[1] = dice.Uniform(-0.04, 0.04);
      point[2] = dice.Uniform(-0.04, 0.04);
      const double angle = (point - sweeps.last()).tail<3>().norm();
      sweeps.Append(point, std::max(0.8, angle / dice.Uniform(0.24, 0.60)));
    }
  }
  return sweeps;
}

/// Values: azimuth, elevation, radius change, then a turn of the camera.
SweepSequence HalfsphereSweeps(int seed, double seconds) {
  Dice dice(seed);
  Vector6d start = Vector6d::Zero();
  start[1] = 0.35;
  SweepSequence sweeps(start);
  double side = 1;
  for (int i = 0; sweeps.duration_s() < seconds; ++i) {
    Vector6d point = Vector6d::Zero();
    const bool over_the_top = i % 3 == 1;
    point[0] = over_the_top ? sweeps.last()[0] : side * dice.Uniform(0.5, 0.95);
    point[1] = over_the_top ? dice.Uniform(0.9, 1.2) : dice.Uniform(0.15, 0.6);
    point[2] = dice.Uniform(-0.08, 0.08);
    for (int axis = 3; axis < 6; ++axis) point[axis] = dice.Uniform(-0.01, 0.01);
    if (over_the_top) point[5] = side * dice.Uniform(1.6, 2.3);
    if (!over_the_top) side = -side;
    const Vector6d step = point - sweeps.last();
    const double length = kSphereRadius * std::hypot(step[0] * std::cos(point[1]), step[1]);
    sweeps.Append(point, std::max(0.8, length / dice.Uniform(0.17, 0.30)));
  }
  return sweeps;
}

SweepSequence MakeSweeps(HandheldKind kind, int seed, double seconds) {
  switch (kind) {
    case HandheldKind::kXyz:
      return XyzSweeps(seed, seconds);
    case HandheldKind::kRpy:
      return RpySweeps(seed, seconds);
    case HandheldKind::kHalfsphere:
      return HalfsphereSweeps(seed, seconds);
    case HandheldKind::kStatic:
      break;
  }
  return SweepSequence(Vector6d::Zero());
}

/// Tremor of hands that hold a camera of half a kilogram: metres and radians.
std::vector<Wander> MakeTremor(HandheldKind kind, int seed) {
  const bool still = kind == HandheldKind::kStatic;
  WanderConfig translation;
  translation.amplitude = still ? 0.0046 : 0.009;
  translation.min_frequency_hz = 0.15;
  translation.max_frequency_hz = 2.5;
  translation.burstiness = 1;
  WanderConfig rotation = translation;
  rotation.amplitude = still ? 0.0172 : kind == HandheldKind::kHalfsphere ? 0.008 : 0.028;
  std::vector<Wander> tremor;
  for (int axis = 0; axis < 3; ++axis) tremor.emplace_back(translation, seed, kTremorStream + axis);
  for (int axis = 3; axis < 6; ++axis) tremor.emplace_back(rotation, seed, kTremorStream + axis);
  return tremor;
}

/// The time within the run; before and after it time comes softly to a halt.
double SoftClamped(double time_s, double seconds) {
  if (time_s < 0) return -kHaltS * (1 - std::exp(time_s / kHaltS));
  if (time_s > seconds) return seconds + kHaltS * (1 - std::exp((seconds - time_s) / kHaltS));
  return time_s;
}

Eigen::Isometry3d OnSphere(const Vector6d& value) {
  const double radius = kSphereRadius + value[2];
  const Eigen::Vector3d direction(-std::cos(value[1]) * std::cos(value[0]),
                                  -std::cos(value[1]) * std::sin(value[0]), std::sin(value[1]));
  Eigen::Isometry3d T = LookAt(kSphereCentre + radius * direction, kSphereCentre);
  T.rotate(ExpSO3(value.tail<3>()));
  return T;
}

}  // namespace

Eigen::Isometry3d LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << right, forward.cross(right), forward;
  T.translation() = position;
  return T;
}

HandheldMotion::HandheldMotion(HandheldKind kind, int seed, double seconds)
    : kind_(kind),
      seconds_(seconds),
      sweeps_(MakeSweeps(kind, seed, seconds + kHaltS)),
      tremor_(MakeTremor(kind, seed)) {}

Eigen::Isometry3d HandheldMotion::T_map_held(double time_s) const {
  const Vector6d value = sweeps_.At(time_s);
  if (kind_ == HandheldKind::kHalfsphere) return OnSphere(value);
  Eigen::Isometry3d T = LookAt(kHeldAt, kTarget);
  T.translate(Eigen::Vector3d(value.head<3>()));
  T.rotate(ExpSO3(value.tail<3>()));
  return T;
}

Eigen::Isometry3d HandheldMotion::T_map_camera(double time_s) const {
  const double t = SoftClamped(time_s, seconds_);
  Vector6d shake;
  for (int axis = 0; axis < 6; ++axis) shake[axis] = tremor_[static_cast<std::size_t>(axis)].At(t);
  return T_map_held(t) * ExpSE3(shake);
}

}  // namespace posefusion
