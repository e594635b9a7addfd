#include "posefusion/loop_closure/fern_database.h"

#include <algorithm>

namespace posefusion {
namespace {

bool IsBetter(const FernMatch& a, const FernMatch& b) {
  if (a.similarity != b.similarity) return a.similarity > b.similarity;
  return a.keyframe.id < b.keyframe.id;
}

}  // namespace

FernDatabase::FernDatabase(const FernConfig& config) : config_(config) {}

void FernDatabase::Clear() { *this = FernDatabase(config_); }

double FernDatabase::Similarity(const FernCode& code, std::size_t index) const {
  const FernComparison comparison =
      CompareFerns(code.data(), codes_.data() + index * code.size(), config_.num_ferns);
  const bool defined = comparison.known >= config_.min_known_share * config_.num_ferns;
  return defined ? comparison.Similarity() : -1;
}

bool FernDatabase::IsKnown(const FernCode& code) const {
  return KnownShare(code) >= config_.min_known_share;
}

bool FernDatabase::AddIfNew(StampNs stamp_ns, const FernCode& code,
                            const Eigen::Isometry3d& T_map_camera) {
  if (!IsKnown(code)) return false;
  const std::size_t count = keyframes_.size();
  std::size_t nearest = 0;
  double highest = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = (last_similar_ + i) % count;  // most often the first decides
    const double similarity = Similarity(code, index);
    if (similarity >= config_.max_similarity) {
      last_similar_ = index;
      return false;
    }
    if (similarity > highest) {
      highest = similarity;
      nearest = index;
    }
  }
  std::size_t place = count;
  if (config_.max_keyframes <= size()) {
    place = nearest;
  } else {
    keyframes_.emplace_back();
    codes_.resize(codes_.size() + code.size());
  }
  keyframes_[place] = {next_id_++, stamp_ns, T_map_camera};
  std::copy(code.begin(), code.end(),
            codes_.begin() + static_cast<std::ptrdiff_t>(place * code.size()));
  last_similar_ = place;
  return true;
}

std::vector<FernMatch> FernDatabase::Query(const FernCode& code, int count,
                                           double min_similarity) const {
  std::vector<FernMatch> matches;
  if (!IsKnown(code)) return matches;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    const double similarity = Similarity(code, i);
    if (similarity >= std::max(0.0, min_similarity)) matches.push_back({keyframes_[i], similarity});
  }
  std::sort(matches.begin(), matches.end(), IsBetter);
  if (static_cast<int>(matches.size()) > count) matches.resize(static_cast<std::size_t>(count));
  return matches;
}

}  // namespace posefusion
