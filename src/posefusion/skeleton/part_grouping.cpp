#include "posefusion/skeleton/part_grouping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "posefusion/skeleton/heat_map_peaks.h"

namespace posefusion {
namespace {

constexpr int kNone = -1;

/// A peak of any part's heat map.
struct Part {
  int joint = 0;
  HeatMapPeak peak;
};

/// Two parts, as indices, that may be the ends of a limb.
struct Limb {
  int from = 0;
  int to = 0;
  float score = 0;
};

/// Strongest first; the indices make the order unique.
bool IsStronger(const Limb& a, const Limb& b) {
  return std::make_tuple(-a.score, a.from, a.to) < std::make_tuple(-b.score, b.from, b.to);
}

/// All peaks, in the order of the joints; `begin[j]` is the first of joint j.
struct Parts {
  std::vector<Part> all;
  std::array<int, kNumCocoJoints + 1> begin{};
};

Parts FindParts(const PartMaps& maps, double threshold) {
  Parts parts;
  for (int joint = 0; joint < kNumCocoJoints; ++joint) {
    const auto index = static_cast<std::size_t>(joint);
    parts.begin[index] = static_cast<int>(parts.all.size());
    for (const HeatMapPeak& peak : FindPeaks(maps.heat[index], threshold)) {
      parts.all.push_back({joint, peak});
    }
  }
  parts.begin[kNumCocoJoints] = static_cast<int>(parts.all.size());
  return parts;
}

/// The value between pixels that lie inside of the map.
float Interpolate(const cv::Mat& map, float x, float y) {
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, map.cols - 1);
  const int y1 = std::min(y0 + 1, map.rows - 1);
  const float wx = x - static_cast<float>(x0);
  const float wy = y - static_cast<float>(y0);
  const float upper = (1 - wx) * map.at<float>(y0, x0) + wx * map.at<float>(y0, x1);
  const float lower = (1 - wx) * map.at<float>(y1, x0) + wx * map.at<float>(y1, x1);
  return (1 - wy) * upper + wy * lower;
}

/// The line integral of the field between two peaks (Cao 2017, eq. 10), less for limbs longer than
/// half of the map's height; 0 or below when the field disagrees on too much of it.
float LimbScore(const cv::Mat& field_x, const cv::Mat& field_y, const HeatMapPeak& from,
                const HeatMapPeak& to, const PartGroupingConfig& config) {
  const float dx = to.x - from.x;
  const float dy = to.y - from.y;
  const float length = std::hypot(dx, dy);
  if (!(length > 0)) return 0;
  float sum = 0;
  int agreeing = 0;
  for (int i = 0; i < config.limb_samples; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(config.limb_samples - 1);
    const float x = from.x + t * dx;
    const float y = from.y + t * dy;
    const float along =
        (Interpolate(field_x, x, y) * dx + Interpolate(field_y, x, y) * dy) / length;
    sum += along;
    if (along > config.field_threshold) ++agreeing;
  }
  if (agreeing < config.min_agreement * config.limb_samples) return 0;
  const float half_height = 0.5F * static_cast<float>(field_x.rows);
  return sum / static_cast<float>(config.limb_samples) + std::min(half_height / length - 1, 0.0F);
}

/// The pairs of one kind of limb: strongest first, each part once (Cao 2017, section 2.4).
std::vector<Limb> MatchLimb(const LimbField& kind, const Parts& parts, const PartMaps& maps,
                            const PartGroupingConfig& config) {
  const auto field = static_cast<std::size_t>(kind.x_field);
  std::vector<Limb> candidates;
  for (int a = parts.begin[kind.from]; a < parts.begin[kind.from + 1]; ++a) {
    for (int b = parts.begin[kind.to]; b < parts.begin[kind.to + 1]; ++b) {
      const float score = LimbScore(maps.affinity[field], maps.affinity[field + 1],
                                    parts.all[static_cast<std::size_t>(a)].peak,
                                    parts.all[static_cast<std::size_t>(b)].peak, config);
      if (score > 0) candidates.push_back({a, b, score});
    }
  }
  std::sort(candidates.begin(), candidates.end(), IsStronger);
  std::vector<Limb> limbs;
  std::vector<bool> taken(parts.all.size());
  for (const Limb& limb : candidates) {
    const auto from = static_cast<std::size_t>(limb.from);
    const auto to = static_cast<std::size_t>(limb.to);
    if (taken[from] || taken[to]) continue;
    taken[from] = taken[to] = true;
    limbs.push_back(limb);
  }
  return limbs;
}

/// Parts of one person: an index per joint, or kNone.
using PersonParts = std::array<int, kNumCocoJoints>;

bool ShareAJoint(const PersonParts& a, const PersonParts& b) {
  for (std::size_t j = 0; j < a.size(); ++j) {
    if (a[j] != kNone && b[j] != kNone) return true;
  }
  return false;
}

/// Joins parts by limbs, strongest first, unless that gave a person two of the same joint.
std::vector<PersonParts> Assemble(const Parts& parts, std::vector<Limb> limbs) {
  PersonParts nobody;
  nobody.fill(kNone);
  std::vector<PersonParts> people(parts.all.size(), nobody);
  for (std::size_t i = 0; i < people.size(); ++i) {
    people[i][static_cast<std::size_t>(parts.all[i].joint)] = static_cast<int>(i);
  }
  std::vector<std::size_t> person_of(parts.all.size());
  std::iota(person_of.begin(), person_of.end(), 0);
  std::sort(limbs.begin(), limbs.end(), IsStronger);
  for (const Limb& limb : limbs) {
    const std::size_t keep = person_of[static_cast<std::size_t>(limb.from)];
    const std::size_t join = person_of[static_cast<std::size_t>(limb.to)];
    if (keep == join || ShareAJoint(people[keep], people[join])) continue;
    for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
      if (people[join][j] == kNone) continue;
      people[keep][j] = people[join][j];
      person_of[static_cast<std::size_t>(people[join][j])] = keep;
    }
    people[join] = nobody;
  }
  return people;
}

/// A person with its joints, number and sum of confidences.
struct Candidate {
  Skeleton skeleton{};
  int num_joints = 0;
  float confidence = 0;
};

Candidate ToCandidate(const PersonParts& person, const Parts& parts) {
  Candidate candidate;
  for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
    if (person[j] == kNone) continue;
    const HeatMapPeak& peak = parts.all[static_cast<std::size_t>(person[j])].peak;
    candidate.skeleton[j] = {peak.x, peak.y, peak.confidence};
    candidate.confidence += peak.confidence;
    ++candidate.num_joints;
  }
  return candidate;
}

}  // namespace

std::vector<Skeleton> GroupParts(const PartMaps& maps, const PartGroupingConfig& config) {
  const Parts parts = FindParts(maps, config.peak_threshold);
  std::vector<Limb> limbs;
  for (const LimbField& kind : kLimbFields) {
    const std::vector<Limb> matched = MatchLimb(kind, parts, maps, config);
    limbs.insert(limbs.end(), matched.begin(), matched.end());
  }
  std::vector<Candidate> people;
  for (const PersonParts& person : Assemble(parts, std::move(limbs))) {
    const Candidate candidate = ToCandidate(person, parts);
    const auto num_joints = static_cast<float>(candidate.num_joints);
    if (candidate.num_joints >= config.min_joints &&
        candidate.confidence >= static_cast<float>(config.min_confidence) * num_joints) {
      people.push_back(candidate);
    }
  }
  std::stable_sort(people.begin(), people.end(), [](const Candidate& a, const Candidate& b) {
    return a.confidence > b.confidence;
  });
  if (people.size() > kMaxPeople) people.resize(kMaxPeople);
  std::vector<Skeleton> skeletons;
  skeletons.reserve(people.size());
  for (const Candidate& person : people) skeletons.push_back(person.skeleton);
  return skeletons;
}

}  // namespace posefusion
