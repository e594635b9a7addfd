#include "posefusion/simulation/choreography.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "posefusion/simulation/floor_grid.h"
#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/traffic.h"

namespace posefusion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kClearance = 0.27;        // half width of a walking body, metres
constexpr double kNarrow = 0.16;           // half width of one that squeezes past
constexpr double kToCamera = 0.55;         // nearer to the robot nobody goes
constexpr double kToCrossedCamera = 0.46;  // except to cross close before it
constexpr double kStepAside = 0.36;        // when there is no other way
constexpr double kForesight_s = 3;         // a place is left in time
constexpr double kTurn_s = 0.8;
constexpr double kPushSpeed = 0.4;  // metres per second

double YawOf(const Vector2d& direction) { return std::atan2(direction.y(), direction.x()); }

/// Walking through the camera's picture.
struct Crossing {
  Vector2d from;
  Vector2d to;
  std::vector<Vector2d> approach;  ///< way to `from`
  double approach_from_s;
  double from_s;
  double duration_s;
};

/// Plans one person after the other; later ones keep away from earlier ones and from the camera.
class Planner {
 public:
  Planner(const WorldConfig& config, const RoomPlan& plan)
      : config_(config),
        plan_(plan),
        grid_(plan.floor, plan.obstacles, kClearance),
        close_grid_(plan.floor, plan.obstacles, kNarrow),
        traffic_(config) {}

  Choreography Plan() {
    result_.moves.resize(plan_.objects.size());
    for (int person = 0; person < config_.humans; ++person) PlanPerson(person);
    if (config_.humans > 0) PlanUnseenMoves();
    return std::move(result_);
  }

 private:
  void PlanPerson(int person);
  void StandFirst(HashSequence& random);
  void StandAt(const Vector2d& place, double yaw, double duration_s, Gesture gesture);
  /// Waits for a free way, goes there and could stay for a while without being in the way.
  bool WalkTo(const Vector2d& goal, double speed, double stay_s, double margin = kToCamera);
  bool Cross(double speed);
  bool PushChair();
  /// Sits down, or sits from the start, and gets up when nobody is in the way.
  void Sit(const Seat& seat, double duration_s, Gesture gesture, bool still);
  void Roam(int person, HashSequence& random);
  void Leave(HashSequence& random);
  void PlanUnseenMoves();

  std::optional<Crossing> CrossingAt(double meet_s, double distance_m, double half_m,
                                     double speed) const;
  Vector2d SomePlace(HashSequence& random) const;

  const WorldConfig& config_;
  const RoomPlan& plan_;
  FloorGrid grid_;
  FloorGrid close_grid_;  ///< for squeezing past
  Traffic traffic_;
  Choreography result_;
  std::vector<Segment> segments_;  ///< of the person being planned
  double now_s_ = 0;
  Vector2d here_ = Vector2d::Zero();
  double yaw_ = 0;
  bool pushed_ = false;
};

/// A free place to go to. In a long corridor people stay near, so that the camera meets them.
Vector2d Planner::SomePlace(HashSequence& random) const {
  for (int attempt = 0; attempt < 40; ++attempt) {
    const auto count = static_cast<int>(plan_.places.size());
    Vector2d place = plan_.places[static_cast<std::size_t>(random.Below(count))];
    place.x() += static_cast<double>(random.Uniform(-0.25F, 0.25F));
    place.y() += static_cast<double>(random.Uniform(-0.25F, 0.25F));
    const double distance = (place - here_).norm();
    if (distance > 0.6 && distance < 5 + attempt && grid_.IsFree(place)) return place;
  }
  return here_;
}

void Planner::StandAt(const Vector2d& place, double yaw, double duration_s, Gesture gesture) {
  segments_.push_back({Activity::kStand, now_s_, now_s_ + duration_s, {place}, yaw, gesture});
  now_s_ += duration_s;
  here_ = place;
  yaw_ = yaw;
}

bool Planner::WalkTo(const Vector2d& goal, double speed, double stay_s, double margin) {
  const std::vector<Vector2d> way = grid_.Way(here_, goal);
  if (way.empty() || LengthOf(way) < 0.3) return false;
  const double duration = LengthOf(way) / speed + 0.5;
  const double first_yaw = YawOf(PointAlong(way, 0.3) - way.front());
  double wait = kTurn_s;
  const auto fits = [&] {
    const double arrival_s = now_s_ + wait + duration;
    return !traffic_.IsTaken(way, now_s_ + wait, duration, margin) &&
           !traffic_.IsTaken(goal, arrival_s, arrival_s + stay_s + kForesight_s, kToCamera);
  };
  while (!fits()) {
    wait += 0.4;
    if (wait > 9 || traffic_.IsTaken(here_, now_s_ + wait, now_s_ + wait, margin)) return false;
  }
  StandAt(here_, first_yaw, wait, Gesture::kNone);
  segments_.push_back({Activity::kWalk, now_s_, now_s_ + duration, way, 0});
  now_s_ += duration;
  here_ = goal;
  yaw_ = YawOf(way.back() - PointAlong(way, LengthOf(way) - 0.3));
  return true;
}

/// A way through the picture of the camera at meet_s, `distance_m` before it, that can be reached.
std::optional<Crossing> Planner::CrossingAt(double meet_s, double distance_m, double half_m,
                                            double speed) const {
  const Eigen::Isometry3d T = config_.head->T_map_camera(meet_s);
  const Vector2d forward = T.linear().col(2).head<2>().normalized();
  const Vector2d middle = T.translation().head<2>() + distance_m * forward;
  const Vector2d side(-forward.y() * half_m, forward.x() * half_m);
  Crossing c{middle + side, middle - side, {}, 0, 0, 2 * std::abs(half_m) / speed + 0.5};
  c.from_s = meet_s - c.duration_s / 2;
  if (!close_grid_.IsFree(c.from, c.to)) return std::nullopt;
  if (traffic_.IsTaken(std::vector<Vector2d>{c.from, c.to}, c.from_s, c.duration_s,
                       kToCrossedCamera))
    return std::nullopt;
  c.approach = grid_.Way(here_, c.from);
  if (c.approach.size() < 2) return std::nullopt;
  const double approach_s = LengthOf(c.approach) / speed + 0.5;
  c.approach_from_s = c.from_s - kTurn_s - approach_s;
  if (c.approach_from_s < now_s_ + 0.3 ||
      traffic_.IsTaken(here_, now_s_, c.approach_from_s, kToCrossedCamera) ||
      traffic_.IsTaken(c.approach, c.approach_from_s, approach_s, kToCrossedCamera)) {
    return std::nullopt;
  }
  return c;
}

/// Walks through the picture of the camera, as near as there is room, from one side to the other.
bool Planner::Cross(double speed) {
  if (!config_.head) return false;
  for (double delay = 3; delay < 11; delay += 0.5) {
    for (const double distance : {0.52, 0.65, 0.8, 1.0}) {
      for (const double half : {0.9, -0.9, 0.65, -0.65}) {
        const auto crossing = CrossingAt(now_s_ + delay, distance, half, speed);
        if (!crossing) continue;
        const Crossing& c = *crossing;
        StandAt(here_, YawOf(PointAlong(c.approach, 0.3) - here_), c.approach_from_s - now_s_,
                Gesture::kNone);
        const double arrival_s = c.from_s - kTurn_s;
        segments_.push_back({Activity::kWalk, now_s_, arrival_s, c.approach, 0});
        now_s_ = arrival_s;
        StandAt(c.from, YawOf(c.to - c.from), kTurn_s, Gesture::kNone);
        segments_.push_back({Activity::kWalk, now_s_, now_s_ + c.duration_s, {c.from, c.to}, 0});
        now_s_ += c.duration_s;
        here_ = c.to;
        yaw_ = YawOf(c.to - c.from);
        return true;
      }
    }
  }
  return false;
}

bool Planner::PushChair() {
  const Vector2d from = plan_.objects.front().from.translation().head<2>();
  const Vector2d to = plan_.objects.front().to.translation().head<2>();
  const Vector2d behind = (from - to).normalized() * 0.62;
  if (!WalkTo(from + behind, 1.0, 4)) return false;
  StandAt(here_, YawOf(-behind), 1.2, Gesture::kPush);
  const double duration = (to - from).norm() / kPushSpeed + 0.5;
  segments_.push_back({Activity::kWalk,
                       now_s_,
                       now_s_ + duration,
                       {from + behind, to + behind},
                       0,
                       Gesture::kPush});
  result_.moves.front() = {true, now_s_, now_s_ + duration};
  now_s_ += duration;
  here_ = to + behind;
  StandAt(here_, YawOf(-behind), 1.0, Gesture::kNone);
  pushed_ = true;
  return true;
}

void Planner::Sit(const Seat& seat, double duration_s, Gesture gesture, bool still) {
  double end_s = now_s_ + duration_s;
  while (end_s < 2 * config_.seconds &&
         traffic_.IsTaken(seat.beside, end_s - 1, end_s + 5, kToCamera + 0.3)) {
    end_s += 1;
  }
  segments_.push_back(
      {Activity::kSit, now_s_, end_s, {seat.position}, seat.yaw_rad, gesture, still});
  now_s_ = end_s;
  StandAt(seat.beside, seat.yaw_rad, 2.2, Gesture::kNone);
}

void Planner::StandFirst(HashSequence& random) {
  here_ = plan_.places.front();
  for (int attempt = 0; attempt < 60; ++attempt) {
    const auto number = random.Below(static_cast<int>(plan_.places.size()));
    here_ = plan_.places[static_cast<std::size_t>(number)];
    if (grid_.IsFree(here_) && !traffic_.IsTaken(here_, 0, 3, 0.8)) break;
  }
  StandAt(here_, static_cast<double>(random.Uniform(-3.1F, 3.1F)), random.Uniform(0.6F, 1.6F),
          Gesture::kNone);
}

void Planner::Leave(HashSequence& random) {
  const auto side = static_cast<std::size_t>(random.Below(static_cast<int>(plan_.outside.size())));
  if (!WalkTo(plan_.outside[side], 1.15, 3)) return;
  StandAt(here_, yaw_, static_cast<double>(random.Uniform(3, 8)), Gesture::kNone);
}

void Planner::Roam(int person, HashSequence& random) {
  const double speed = static_cast<double>(random.Uniform(0.85F, 1.25F));
  const int what = random.Below(8);
  if (person == 0 && !pushed_ && now_s_ > 0.3 * config_.seconds && PushChair()) return;
  if (what <= 3 && Cross(speed)) return;
  if (what == 4) return Leave(random);
  const double stay_s = static_cast<double>(random.Uniform(1.0F, 5.0F));
  const auto gesture = static_cast<Gesture>(random.Below(4));
  for (int attempt = 0; attempt < 30; ++attempt) {
    const double margin = attempt < 12 ? kToCamera : kStepAside;
    if (!WalkTo(SomePlace(random), speed, stay_s, margin)) continue;
    return StandAt(here_, yaw_ + static_cast<double>(random.Uniform(-2, 2)), stay_s, gesture);
  }
  StandAt(here_, yaw_, 0.5, Gesture::kNone);
}

void Planner::PlanPerson(int person) {
  const auto seed = static_cast<std::uint32_t>(config_.seed);
  HashSequence random(seed, 500, static_cast<std::uint32_t>(person));
  segments_.clear();
  now_s_ = 0;
  pushed_ = false;
  const BodyShape shape(static_cast<double>(random.Uniform(1.58F, 1.88F)),
                        static_cast<double>(random.Uniform(0.92F, 1.12F)));
  if (person == 1) {
    Sit(plan_.seats.front(), std::max(34.0, 0.5 * config_.seconds), Gesture::kType, true);
  } else {
    StandFirst(random);
  }
  bool has_sat = person != 2;
  while (now_s_ < config_.seconds) {
    const Seat& seat = plan_.seats.back();
    if (!has_sat && now_s_ > 4 && plan_.seats.size() > 1 && WalkTo(seat.beside, 1.0, 1)) {
      has_sat = true;
      Sit(seat, 8, Gesture::kTalk, false);
    }
    Roam(person, random);
  }
  result_.shapes.push_back(shape);
  result_.people.emplace_back(shape, segments_);
  const PersonTimeline& timeline = result_.people.back();
  traffic_.AddPerson([&](double time_s) { return timeline.FloorAt(time_s); });
}

/// The other objects change their place while the camera looks elsewhere.
void Planner::PlanUnseenMoves() {
  for (std::size_t i = 1; i < plan_.objects.size(); ++i) {
    const auto unseen = [&](double t) {
      if (!config_.head) return true;
      const Eigen::Isometry3d T_camera_map = config_.head->T_map_camera(t).inverse();
      for (const auto& pose : {plan_.objects[i].from, plan_.objects[i].to}) {
        const Vector3d p = T_camera_map * pose.translation();
        if (p.z() > 0.85 * p.norm() && p.norm() < 8) return false;
      }
      return true;
    };
    const double first = config_.seconds * (0.25 + 0.2 * static_cast<double>(i));
    for (double t = first; t < config_.seconds; t += 0.2) {
      if (!unseen(t) || !unseen(t + 0.4)) continue;
      result_.moves[i] = {true, t + 0.1, t + 0.3};
      break;
    }
  }
}

}  // namespace

Choreography MakeChoreography(const WorldConfig& config, const RoomPlan& plan) {
  return Planner(config, plan).Plan();
}

}  // namespace posefusion
