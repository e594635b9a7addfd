#include "posefusion/segmentation/remembered_people.h"

#include <cmath>

#include "posefusion/segmentation/people_memory.h"

namespace posefusion {
namespace {

/// Takes single places into a frame.
class Remembering {
 public:
  Remembering(const Eigen::Isometry3f& T_now_before, const CellGrid& cells, double time_s,
              float interval_s, const RememberedPeopleConfig& config,
              const PeopleVelocities& velocities, CellPeople& people, RememberedPeople& remembered)
      : T_now_before_(T_now_before),
        cells_(cells),
        time_s_(time_s),
        interval_s_(interval_s),
        config_(config),
        velocities_(velocities),
        people_(people),
        remembered_(remembered) {}

  void Take(RememberedPlace place) {
    const double age_s = time_s_ - place.seen_s;
    if (age_s > config_.memory_s) return;
    place.p_camera = T_now_before_ * (place.p_camera + Walk(place.person));
    if (!IsInView(place.p_camera)) return Keep(place);
    const auto cell = cells_.CellNear(cells_.PlaceOf(place.p_camera.cast<double>()));
    if (!cell) return Keep(place);
    const float z = cells_.DepthAt(cell->x, cell->y);
    const auto limit_m = static_cast<float>(config_.max_difference_m + config_.speed_m_s * age_s);
    if (z <= 0 || z < place.p_camera.z() - limit_m) return Keep(place);
    if (z > place.p_camera.z() + limit_m || people_.person.at(cell->x, cell->y) != kUnknownCell)
      return;
    people_.person.at(cell->x, cell->y) = place.person;
    people_.evidence.at(cell->x, cell->y) = place.evidence;
  }

 private:
  static bool IsInView(const Eigen::Vector3f& p_camera) { return p_camera.z() > 0.1F; }
  /// How far somebody has walked since the frame before.
  Eigen::Vector3f Walk(CellPerson person) const {
    const auto& velocity = velocities_[person];
    if (!velocity || velocity->norm() < static_cast<float>(config_.min_walk_m_s))
      return Eigen::Vector3f::Zero();
    return *velocity * interval_s_;
  }
  void Keep(const RememberedPlace& place) { remembered_.push_back(place); }

  const Eigen::Isometry3f T_now_before_;
  const CellGrid& cells_;
  const double time_s_;
  const float interval_s_;
  const RememberedPeopleConfig& config_;
  const PeopleVelocities& velocities_;
  CellPeople& people_;
  RememberedPeople& remembered_;
};

}  // namespace

void RememberPeople(const PeopleThen& before, const Eigen::Isometry3f& T_before_now,
                    const CellGrid& cells, double time_s, const RememberedPeopleConfig& config,
                    CellPeople& people, RememberedPeople& remembered) {
  remembered.clear();
  const auto interval_s = static_cast<float>(time_s - before.time_s);
  Remembering remembering(T_before_now.inverse(), cells, time_s, interval_s, config,
                          before.velocities, people, remembered);
  for (int y = 0; y < before.cells.height(); ++y) {
    for (int x = 0; x < before.cells.width(); ++x) {
      const CellPerson person = before.people.person.at(x, y);
      if (!IsPerson(person)) continue;
      const float evidence = before.people.evidence.at(x, y);
      if (evidence < kFirstEvidence || before.cells.DepthAt(x, y) <= 0) continue;
      remembering.Take({before.cells.PointAt(x, y), person, evidence, before.time_s});
    }
  }
  for (const RememberedPlace& place : before.remembered) remembering.Take(place);
}

}  // namespace posefusion
