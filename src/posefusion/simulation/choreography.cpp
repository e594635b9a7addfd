#include "posefusion/simulation/choreography.h"

#include <algorithm>
#include <set>
#include <utility>

#include "posefusion/simulation/crossing.h"
#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/visit.h"

namespace posefusion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPushSpeed = 0.4;     // metres per second
constexpr double kClosePeriod_s = 60;  // somebody passes close before the camera
constexpr int kMinPeopleForClose = 2;
constexpr double kVisitLead_s = 14;     // a visit is thought of so long before
constexpr double kLatestArrival_s = 1;  // before its end
constexpr int kMaxRevisions = 12;       // of what was done before a visit

/// Plans one person after the other; later ones keep away from earlier ones and from the camera.
class Planner {
 public:
  Planner(const WorldConfig& config, const RoomPlan& plan)
      : config_(config), plan_(plan), stage_(config, plan), visits_(config.visits) {}

  Choreography Plan() {
    result_.moves.resize(plan_.objects.size());
    for (int person = 0; person < config_.humans; ++person) PlanPerson(person);
    if (config_.humans > 0) PlanUnseenMoves();
    return std::move(result_);
  }

 private:
  /// How far the plan of a person has come.
  struct Progress {
    Script script;
    bool has_sat = false;
    Choreography::Move push;
  };

  void PlanPerson(int person);
  void StandFirst(HashSequence& random, Script& script) const;
  /// Does what has to happen before the camera; false when there is nothing to be done or no way.
  bool MeetCamera(Script& script);
  void DoSomething(int person, HashSequence& random, Progress& progress) const;
  bool PushChair(Progress& progress) const;
  void Roam(int person, HashSequence& random, Progress& progress) const;
  bool WalkAbout(HashSequence& random, double speed, Script& script) const;
  void Leave(HashSequence& random, Script& script) const;
  void PlanUnseenMoves();
  bool IsMissed(const CameraVisit& visit, const Script& script) const;
  Vector2d SomePlace(const Vector2d& here, HashSequence& random) const;

  const WorldConfig& config_;
  const RoomPlan& plan_;
  Stage stage_;
  Choreography result_;
  std::vector<CameraVisit> visits_;  ///< that nobody has made yet, in order of time
  std::set<int> close_done_;         ///< periods in which somebody has passed close by
};

/// A free place to go to. In a long corridor people stay near, so that the camera meets them.
Vector2d Planner::SomePlace(const Vector2d& here, HashSequence& random) const {
  for (int attempt = 0; attempt < 40; ++attempt) {
    const auto count = static_cast<int>(plan_.places.size());
    Vector2d place = plan_.places[static_cast<std::size_t>(random.Below(count))];
    place.x() += static_cast<double>(random.Uniform(-0.25F, 0.25F));
    place.y() += static_cast<double>(random.Uniform(-0.25F, 0.25F));
    const double distance = (place - here).norm();
    if (distance > 0.6 && distance < 5 + attempt && stage_.grid.IsFree(place)) return place;
  }
  return here;
}

bool Planner::PushChair(Progress& progress) const {
  Script& script = progress.script;
  const Vector2d from = plan_.objects.front().from.translation().head<2>();
  const Vector2d to = plan_.objects.front().to.translation().head<2>();
  const Vector2d behind = (from - to).normalized() * 0.62;
  if (!script.WalkTo(from + behind, 1.0, 4)) return false;
  script.StandAt(script.here(), YawOf(-behind), 1.2, Gesture::kPush);
  const double start_s = script.now_s();
  script.Walk({from + behind, to + behind}, (to - from).norm() / kPushSpeed + 0.5, Gesture::kPush);
  progress.push = {true, start_s, script.now_s()};
  script.StandAt(script.here(), YawOf(-behind), 1.0, Gesture::kNone);
  return true;
}

void Planner::StandFirst(HashSequence& random, Script& script) const {
  Vector2d place = plan_.places.front();
  for (int attempt = 0; attempt < 60; ++attempt) {
    const auto number = random.Below(static_cast<int>(plan_.places.size()));
    place = plan_.places[static_cast<std::size_t>(number)];
    if (stage_.grid.IsFree(place) && !stage_.traffic.IsTaken(place, 0, 3, 0.8)) break;
  }
  script.StandAt(place, static_cast<double>(random.Uniform(-3.1F, 3.1F)),
                 random.Uniform(0.6F, 1.6F), Gesture::kNone);
}

void Planner::Leave(HashSequence& random, Script& script) const {
  const auto side = static_cast<std::size_t>(random.Below(static_cast<int>(plan_.outside.size())));
  if (!script.WalkTo(plan_.outside[side], 1.15, 3)) return;
  script.StandAt(script.here(), script.yaw_rad(), static_cast<double>(random.Uniform(3, 8)),
                 Gesture::kNone);
}

bool Planner::WalkAbout(HashSequence& random, double speed, Script& script) const {
  const double stay_s = static_cast<double>(random.Uniform(1.0F, 5.0F));
  const auto gesture = static_cast<Gesture>(random.Below(4));
  for (int attempt = 0; attempt < 30; ++attempt) {
    const double margin = attempt < 12 ? kToCamera : kStepAside;
    if (!script.WalkTo(SomePlace(script.here(), random), speed, stay_s, margin)) continue;
    const double yaw = script.yaw_rad() + static_cast<double>(random.Uniform(-2, 2));
    script.StandAt(script.here(), yaw, stay_s, gesture);
    return true;
  }
  return false;
}

void Planner::Roam(int person, HashSequence& random, Progress& progress) const {
  Script& script = progress.script;
  const double speed = static_cast<double>(random.Uniform(0.85F, 1.25F));
  const int what = random.Below(8);
  const bool may_push =
      person == 0 && !progress.push.happens && script.now_s() > 0.3 * config_.seconds;
  if (may_push && PushChair(progress)) return;
  if (what <= 3 && Cross(CrossingKind::kNear, stage_, speed, script)) return;
  if (what == 4) return Leave(random, script);
  if (WalkAbout(random, speed, script)) return;
  script.StandAt(script.here(), script.yaw_rad(), 0.5, Gesture::kNone);
}

void Planner::DoSomething(int person, HashSequence& random, Progress& progress) const {
  Script& script = progress.script;
  const Seat& seat = plan_.seats.back();
  const bool may_sit = person == 2 && !progress.has_sat && script.now_s() > 4;
  if (may_sit && plan_.seats.size() > 1 && script.WalkTo(seat.beside, 1.0, 1)) {
    progress.has_sat = true;
    script.Sit(seat, 8, Gesture::kTalk, false);
  }
  Roam(person, random, progress);
}

bool Planner::MeetCamera(Script& script) {
  constexpr double kSpeed = 1.1;
  const auto visit = std::find_if(visits_.begin(), visits_.end(),
                                  [&](const CameraVisit& v) { return !IsMissed(v, script); });
  if (visit != visits_.end() && visit->from_s - script.now_s() < kVisitLead_s) {
    if (!VisitCamera(*visit, stage_, kSpeed, script)) return false;
    visits_.erase(visit);
    return true;
  }
  const int period = static_cast<int>(script.now_s() / kClosePeriod_s);
  if (config_.humans < kMinPeopleForClose || close_done_.count(period) > 0) return false;
  if (!Cross(CrossingKind::kClose, stage_, kSpeed, script)) return false;
  close_done_.insert(period);
  return true;
}

/// Whether it is too late for the visit.
bool Planner::IsMissed(const CameraVisit& visit, const Script& script) const {
  return script.now_s() > visit.to_s - kLatestArrival_s;
}

void Planner::PlanPerson(int person) {
  HashSequence random(static_cast<std::uint32_t>(config_.seed), 500,
                      static_cast<std::uint32_t>(person));
  // Who passes close by is as tall as the camera's view is high.
  const BodyShape shape(static_cast<double>(random.Uniform(person == 0 ? 1.72F : 1.58F, 1.88F)),
                        static_cast<double>(random.Uniform(0.92F, 1.12F)));
  Progress progress{Script(stage_), false, {}};
  if (person == 1) {
    progress.script.Sit(plan_.seats.front(), std::max(34.0, 0.5 * config_.seconds), Gesture::kType,
                        true);
  } else {
    StandFirst(random, progress.script);
  }
  int num_revisions = 0;
  while (progress.script.now_s() < config_.seconds) {
    if (MeetCamera(progress.script)) continue;
    const Progress before = progress;
    DoSomething(person, random, progress);
    const bool comes_too_late =
        std::any_of(visits_.begin(), visits_.end(), [&](const CameraVisit& visit) {
          return !IsMissed(visit, before.script) && IsMissed(visit, progress.script);
        });
    if (!comes_too_late) continue;
    if (++num_revisions <= kMaxRevisions) progress = before;
  }
  if (person == 0) result_.moves.front() = progress.push;
  result_.shapes.push_back(shape);
  result_.people.emplace_back(shape, progress.script.segments());
  const PersonTimeline& timeline = result_.people.back();
  stage_.traffic.AddPerson([&](double time_s) { return timeline.FloorAt(time_s); });
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
