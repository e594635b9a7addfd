#include "posefusion/skeleton/skeleton_checks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace posefusion {
namespace {

constexpr double kMaxPixel = 1e6;  ///< no image is that large

bool IsPixel(double value) { return std::abs(value) < kMaxPixel; }  // false for NaN

float TotalConfidence(const Skeleton& person) {
  return std::accumulate(person.begin(), person.end(), 0.0F,
                         [](float sum, const Joint& joint) { return sum + joint.p; });
}

/// True where rounding gives one of the pixels.
bool IsInside(const Joint& joint, int width, int height) {
  return joint.u >= -0.5F && joint.v >= -0.5F && joint.u < static_cast<float>(width) - 0.5F &&
         joint.v < static_cast<float>(height) - 0.5F;
}

}  // namespace

Joint UsableJoint(double u, double v, double p) {
  const bool found = IsPixel(u) && IsPixel(v) && p > 0 && std::isfinite(p);
  if (!found) return {};
  return {static_cast<float>(u), static_cast<float>(v), static_cast<float>(std::min(p, 1.0))};
}

int KeepMostCertain(std::vector<Skeleton>& people) {
  const auto max_people = static_cast<std::size_t>(kMaxPeople);
  if (people.size() <= max_people) return 0;
  std::vector<std::size_t> order(people.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return TotalConfidence(people[a]) > TotalConfidence(people[b]);
  });
  order.resize(max_people);
  std::sort(order.begin(), order.end());
  std::vector<Skeleton> kept;
  for (const std::size_t i : order) kept.push_back(people[i]);
  const auto num_gone = static_cast<int>(people.size() - max_people);
  people = std::move(kept);
  return num_gone;
}

void DropUnusable(std::vector<Skeleton>& people, int width, int height) {
  for (Skeleton& person : people) {
    for (Joint& joint : person) {
      if (!IsInside(joint, width, height)) joint = {};
    }
  }
  const auto nobody = [](const Skeleton& person) {
    return std::all_of(person.begin(), person.end(),
                       [](const Joint& joint) { return joint.p <= 0; });
  };
  people.erase(std::remove_if(people.begin(), people.end(), nobody), people.end());
}

}  // namespace posefusion
