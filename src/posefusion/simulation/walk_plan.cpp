#include "posefusion/simulation/walk_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "posefusion/simulation/easing.h"
#include "posefusion/simulation/fall_choice.h"
#include "posefusion/simulation/indexed_random.h"

namespace posefusion {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kIntervalS = 0.1;
constexpr int kPlanStream = 302;
constexpr double kSharpCornerRad = 0.35;  ///< it stops and turns at sharper corners
constexpr double kMinTurnRad = 0.1;
constexpr double kMaxYawRateWalking = 0.4;  ///< rad/s
constexpr double kTurnStepping = 0.7;       ///< steps in place shake less
constexpr std::size_t kNumFallViews = 3;
constexpr double kStandClearanceM = 0.35;
constexpr double kSetDownM = 0.35;  ///< away from where it fell

double Wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

double HeadingOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

Eigen::Vector2d DirectionOf(double heading) { return {std::cos(heading), std::sin(heading)}; }

class Planner {
 public:
  Planner(const Route& route, const std::vector<Eigen::AlignedBox2d>& obstacles,
          const WalkPlanConfig& config)
      : route_(route),
        obstacles_(obstacles),
        config_(config),
        random_(config.seed, kPlanStream),
        position_(route.points.at(0)),
        next_fall_s_(config.first_fall_s > 0 ? config.first_fall_s + Dice(-1, 1)
                                             : std::numeric_limits<double>::infinity()) {
    heading_ = HeadingOf(route.points.at(1 % route.points.size()) - position_);
  }

  WalkPlan Plan() {
    Stand(1.0);
    while (time_s() < config_.seconds && !AtEnd()) {
      WalkLeg();
      if (time_s() >= next_fall_s_) {
        FallDown();
      } else {
        LookAround();
      }
    }
    Stand(1.0);
    return {WalkPlan::Track(std::move(samples_), kIntervalS), std::move(falls_)};
  }

 private:
  double time_s() const { return static_cast<double>(samples_.size()) * kIntervalS; }
  double Dice(double low, double high) { return random_.Uniform(next_dice_++, low, high); }
  bool AtEnd() const { return !route_.closed && next_point_ >= route_.points.size(); }
  const Eigen::Vector2d& Point(std::size_t i) const {
    return route_.points[i % route_.points.size()];
  }

  void Push(double stepping) {
    samples_.emplace_back(position_.x(), position_.y(), heading_, stepping);
  }

  void Stand(double seconds) {
    for (double left = seconds; left > 0; left -= kIntervalS) Push(0);
  }

  void TurnTo(double heading) {
    const double start = heading_;
    const double angle = Wrapped(heading - start);
    if (std::abs(angle) < kMinTurnRad) return;
    const int num_steps = 1 + static_cast<int>(std::abs(angle) / (route_.turn_rad_s * kIntervalS));
    for (int i = 1; i <= num_steps; ++i) {
      heading_ = start + angle * i / num_steps;
      Push(kTurnStepping);
    }
    Stand(0.3);
  }

  /// Points from here to the next stop: a sharp corner, the end, or after about leg_m.
  std::vector<Eigen::Vector2d> TakeLeg() {
    const double wanted_m = route_.leg_m * Dice(0.8, 1.2);
    std::vector<Eigen::Vector2d> leg = {position_};
    double length_m = 0;
    while (!AtEnd() && length_m < wanted_m) {
      const Eigen::Vector2d& point = Point(next_point_);
      const Eigen::Vector2d step = point - leg.back();
      const bool corner =
          leg.size() > 1 &&
          std::abs(Wrapped(HeadingOf(step) - HeadingOf(leg.back() - leg[leg.size() - 2]))) >
              kSharpCornerRad;
      if (corner) break;
      // A long straight is walked in parts.
      if (length_m + step.norm() > 1.5 * wanted_m) {
        leg.push_back(leg.back() + step.normalized() * (wanted_m - length_m));
        break;
      }
      length_m += step.norm();
      leg.push_back(point);
      ++next_point_;
    }
    return leg;
  }

  void WalkLeg() {
    const std::vector<Eigen::Vector2d> leg = TakeLeg();
    if (leg.size() < 2) return;
    TurnTo(HeadingOf(leg[1] - leg[0]));
    double length_m = 0;
    for (std::size_t i = 1; i < leg.size(); ++i) length_m += (leg[i] - leg[i - 1]).norm();
    double speed = 0;
    double done_m = 0;
    while (done_m < length_m - 1e-3 && time_s() < config_.seconds && time_s() < next_fall_s_) {
      const double braking = std::sqrt(2 * config_.acceleration_m_s2 * (length_m - done_m));
      speed = std::min({speed + config_.acceleration_m_s2 * kIntervalS, route_.speed_m_s,
                        std::max(braking, 0.02)});
      done_m = std::min(done_m + speed * kIntervalS, length_m);
      StepAlong(leg, done_m);
    }
  }

  /// Goes to the place `done_m` along the leg, turning towards its direction.
  void StepAlong(const std::vector<Eigen::Vector2d>& leg, double done_m) {
    std::size_t i = 1;
    while (i + 1 < leg.size() && done_m > (leg[i] - leg[i - 1]).norm()) {
      done_m -= (leg[i] - leg[i - 1]).norm();
      ++i;
    }
    const Eigen::Vector2d direction = (leg[i] - leg[i - 1]).normalized();
    position_ = leg[i - 1] + direction * done_m;
    const double most = kMaxYawRateWalking * kIntervalS;
    heading_ += std::clamp(Wrapped(HeadingOf(direction) - heading_), -most, most);
    Push(1);
  }

  /// Every second time it turns aside and back.
  void LookAround() {
    Stand(Dice(0.4, 1.2));
    ++num_stops_;
    if (num_stops_ % 2 == 1 || route_.look_aside_rad == 0 || time_s() >= config_.seconds) return;
    const double before = heading_;
    TurnTo(heading_ + route_.look_aside_rad * Dice(0.7, 1.3));
    Stand(Dice(0.3, 1.0));
    TurnTo(before);
  }

  /// Begins a fall; the camera sees another thing from fall to fall.
  Fall StartFall() {
    Fall fall;
    fall.view = static_cast<FallView>((falls_.size() + static_cast<std::size_t>(config_.seed)) %
                                      kNumFallViews);
    fall.lying_s = Dice(2, 4);
    fall.tilt_rad = Dice(1.25, 1.36);
    const FallSite site{
        position_, heading_, {route_.gaze_yaw_rad, route_.gaze_pitch_rad}, obstacles_};
    const FallChoice choice =
        ChooseFall(fall, site, [this](double low, double high) { return Dice(low, high); });
    fall.direction = choice.direction;
    TurnTo(choice.heading_rad);
    fall.start_s = time_s();
    return fall;
  }

  /// A free place near by; the present one when there is none.
  Eigen::Vector2d ChooseSetDown() {
    for (int attempt = 0; attempt < 12; ++attempt) {
      const Eigen::Vector2d place = position_ + kSetDownM * DirectionOf(Dice(-kPi, kPi));
      if (FloorClearance(place, obstacles_) >= kStandClearanceM) return place;
    }
    return position_;
  }

  void FallDown() {
    const Fall fall = StartFall();
    while (time_s() < fall.carry_s()) Push(0);
    const Eigen::Vector2d from = position_;
    const Eigen::Vector2d to = ChooseSetDown();
    const double heading = heading_;
    const double turn = (Dice(0, 1) < 0.5 ? 1 : -1) * Dice(0.6, 1.6);
    while (time_s() < fall.lower_s()) {
      const double part = Ease((time_s() - fall.carry_s()) / (fall.lower_s() - fall.carry_s()));
      position_ = from + part * (to - from);
      heading_ = heading + part * turn;
      Push(0);
    }
    while (time_s() < fall.standing_s() + 1.0) Push(0);
    falls_.push_back(fall);
    next_fall_s_ += std::max(config_.fall_period_s + Dice(-1, 1), 1.0);
  }

  const Route& route_;
  const std::vector<Eigen::AlignedBox2d>& obstacles_;
  const WalkPlanConfig config_;
  const IndexedRandom random_;
  int next_dice_ = 0;
  int num_stops_ = 0;
  Eigen::Vector2d position_;
  double heading_ = 0;
  double next_fall_s_;
  std::size_t next_point_ = 1;
  std::vector<WalkPlan::Track::Value> samples_;
  std::vector<Fall> falls_;
};

}  // namespace

WalkPlan PlanWalk(const Route& route, const std::vector<Eigen::AlignedBox2d>& obstacles,
                  const WalkPlanConfig& config) {
  return Planner(route, obstacles, config).Plan();
}

}  // namespace posefusion
