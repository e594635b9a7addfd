#include "posefusion/simulation/fall.h"

#include "posefusion/simulation/easing.h"

namespace posefusion {
namespace {

// A head at 1.5 m that tips freely from a slight lean takes 0.7 to 0.9 s to the floor.
constexpr double kTippingS = 0.8;
constexpr double kRaisingS = 2.5;
constexpr double kCarryingS = 2.0;
constexpr double kLoweringS = 1.0;
constexpr double kLiftM = 0.07;
constexpr double kImpactTiltRad = 0.05;
constexpr double kImpactHz = 6;
constexpr double kImpactDecayPerS = 8;
constexpr double kSetDownTiltRad = 0.015;

}  // namespace

double Fall::impact_s() const { return start_s + kTippingS; }
double Fall::raise_s() const { return impact_s() + lying_s; }
double Fall::carry_s() const { return raise_s() + kRaisingS; }
double Fall::lower_s() const { return carry_s() + kCarryingS; }
double Fall::standing_s() const { return lower_s() + kLoweringS; }

Eigen::Isometry3d Fall::T_footprint_tipped(double time_s) const {
  const double down = Ease((time_s - start_s) / kTippingS);
  const double up = Ease((time_s - raise_s()) / kRaisingS);
  const double lowered = Ease((time_s - lower_s()) / kLoweringS);
  const double ringing =
      -kImpactTiltRad * Ringing(time_s - impact_s(), kImpactHz, kImpactDecayPerS) +
      kSetDownTiltRad * Ringing(time_s - standing_s(), kImpactHz, kImpactDecayPerS);
  const double tilt = tilt_rad * (down - up) + ringing;
  Eigen::Isometry3d T(Eigen::Translation3d(0, 0, kLiftM * (up - lowered)));
  T.rotate(Eigen::AngleAxisd(tilt, Eigen::Vector3d(-direction.y(), direction.x(), 0)));
  return T;
}

}  // namespace posefusion
