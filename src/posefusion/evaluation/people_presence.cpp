#include "posefusion/evaluation/people_presence.h"

#include <algorithm>

namespace posefusion {
namespace {

constexpr StampNs kHalfFrameNs = 16'666'667;  ///< of 30 Hz

}  // namespace

bool IsInside(const PersonCapsule& capsule, const Eigen::Vector3f& point) {
  const Eigen::Vector3f axis = capsule.end_m - capsule.begin_m;
  const Eigen::Vector3f offset = point - capsule.begin_m;
  const float square = axis.squaredNorm();
  const float along = square > 0 ? std::clamp(offset.dot(axis) / square, 0.0F, 1.0F) : 0;
  return (offset - along * axis).norm() <= capsule.radius_m;
}

PeoplePresence::PeoplePresence(const std::vector<PeopleAtStamp>& people, double margin_m) {
  for (const PeopleAtStamp& now : people) {
    Moment moment{now.stamp_ns, Eigen::AlignedBox3f(), now.capsules};
    for (PersonCapsule& capsule : moment.capsules) {
      capsule.radius_m += static_cast<float>(margin_m);
      const Eigen::Vector3f extent = Eigen::Vector3f::Constant(capsule.radius_m);
      for (const Eigen::Vector3f& end : {capsule.begin_m, capsule.end_m}) {
        moment.box.extend(end - extent).extend(end + extent);
      }
    }
    moments_.push_back(moment);
  }
}

bool PeoplePresence::WasAt(const Eigen::Vector3f& point, StampNs begin_ns, StampNs end_ns) const {
  const auto is_earlier = [](const Moment& m, StampNs stamp_ns) { return m.stamp_ns < stamp_ns; };
  auto moment =
      std::lower_bound(moments_.begin(), moments_.end(), begin_ns - kHalfFrameNs, is_earlier);
  for (; moment != moments_.end() && moment->stamp_ns <= end_ns + kHalfFrameNs; ++moment) {
    if (!moment->box.contains(point)) continue;
    const auto holds_point = [&](const PersonCapsule& c) { return IsInside(c, point); };
    if (std::any_of(moment->capsules.begin(), moment->capsules.end(), holds_point)) return true;
  }
  return false;
}

}  // namespace posefusion
