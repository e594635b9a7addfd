#include "posefusion/common/association.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

/// A stamp with its place in the caller's list. Seconds in double precision, because the TUM
/// scripts compute with them: a tie between two neighbours then falls the same way.
struct Entry {
  double stamp_s = 0;
  std::size_t index = 0;
};

struct Candidate {
  double difference_s = 0;
  Entry first;
  Entry second;
};

bool IsEarlier(const Entry& a, const Entry& b) { return a.stamp_s < b.stamp_s; }

std::vector<Entry> SortedEntries(const std::vector<StampNs>& stamps_ns) {
  std::vector<Entry> entries;
  entries.reserve(stamps_ns.size());
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
    entries.push_back({ToSeconds(stamps_ns[i]), i});
  }
  std::stable_sort(entries.begin(), entries.end(), IsEarlier);
  return entries;
}

/// All pairs closer than the limit, the closest first.
std::vector<Candidate> SortedCandidates(const std::vector<Entry>& first,
                                        const std::vector<Entry>& second, double max_difference_s) {
  std::vector<Candidate> candidates;
  for (const Entry& a : first) {
    const Entry earliest{a.stamp_s - 2 * max_difference_s, 0};
    auto b = std::lower_bound(second.begin(), second.end(), earliest, IsEarlier);
    for (; b != second.end() && b->stamp_s < a.stamp_s + 2 * max_difference_s; ++b) {
      const double difference_s = std::abs(a.stamp_s - b->stamp_s);
      if (difference_s < max_difference_s) candidates.push_back({difference_s, a, *b});
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.difference_s < b.difference_s; });
  return candidates;
}

}  // namespace

std::vector<StampMatch> AssociateStamps(const std::vector<StampNs>& first_ns,
                                        const std::vector<StampNs>& second_ns,
                                        double max_difference_s) {
  std::vector<bool> first_taken(first_ns.size());
  std::vector<bool> second_taken(second_ns.size());
  std::vector<Candidate> matches;
  for (const Candidate& candidate :
       SortedCandidates(SortedEntries(first_ns), SortedEntries(second_ns), max_difference_s)) {
    if (first_taken[candidate.first.index] || second_taken[candidate.second.index]) continue;
    first_taken[candidate.first.index] = true;
    second_taken[candidate.second.index] = true;
    matches.push_back(candidate);
  }
  std::sort(matches.begin(), matches.end(),
            [](const Candidate& a, const Candidate& b) { return IsEarlier(a.first, b.first); });
  std::vector<StampMatch> result;
  result.reserve(matches.size());
  for (const Candidate& match : matches) result.push_back({match.first.index, match.second.index});
  return result;
}

}  // namespace posefusion
