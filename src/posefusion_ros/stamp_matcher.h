#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

struct StampMatcherOptions {
  double max_difference_s = 0.02;  ///< stamps of a pair differ by less than this
  /// Take the nearest partner that is already there instead of waiting for what is still to come.
  /// For streams whose senders emit only pairs: no waiting for the next message.
  bool eager = false;
  /// Items of a stream that wait for a partner; beyond that the oldest are given up.
  std::size_t capacity = 30;
};

/// Pairs the items of two streams by stamp, one to one: always the closest two that are left, which
/// is exactly what AssociateStamps makes of the complete lists of stamps. A pair is decided as soon
/// as nothing that is still to come can change it, so the result does not depend on how the streams
/// interleave. Pairs come out in the order of the first stream.
///
/// An item that repeats its stream's last stamp is ignored; one that is older says that time has
/// been turned back (a bag restarted): what waits is forgotten. Not thread-safe.
template <class First, class Second>
class StampMatcher {
 public:
  using Pair = std::pair<First, Second>;

  explicit StampMatcher(const StampMatcherOptions& options) : options_(options) {}

  /// Each returns the pairs that have become certain, often none.
  std::vector<Pair> AddFirst(StampNs stamp_ns, First item) {
    if (Append(first_, stamp_ns, std::move(item))) Decide(options_.eager);
    return TakeDecided();
  }
  std::vector<Pair> AddSecond(StampNs stamp_ns, Second item) {
    if (Append(second_, stamp_ns, std::move(item))) Decide(options_.eager);
    return TakeDecided();
  }

  /// The pairs left when nothing more comes.
  std::vector<Pair> Flush() {
    Decide(true);
    first_.items.clear();
    second_.items.clear();
    return TakeDecided();
  }

  /// Smallest stamp difference among items that wait, to explain why nothing matches.
  std::optional<double> ClosestMissS() const {
    std::optional<double> closest_s;
    for (const auto& a : first_.items) {
      for (const auto& b : second_.items) {
        const double difference_s = Difference(a.stamp_ns, b.stamp_ns);
        if (!closest_s || difference_s < *closest_s) closest_s = difference_s;
      }
    }
    return closest_s;
  }

 private:
  template <class T>
  struct Item {
    StampNs stamp_ns;
    T value;
  };
  template <class T>
  struct Stream {
    std::deque<Item<T>> items;  ///< unmatched, by stamp
    std::optional<StampNs> last_ns;
  };
  struct Decided {
    StampNs first_ns;
    Pair pair;
  };

  /// In double precision as AssociateStamps: ties must fall the same way.
  static double Difference(StampNs a, StampNs b) { return std::abs(ToSeconds(a) - ToSeconds(b)); }

  /// False when the item was ignored.
  template <class T>
  bool Append(Stream<T>& stream, StampNs stamp_ns, T item) {
    if (stream.last_ns && stamp_ns == *stream.last_ns) return false;
    if (stream.last_ns && stamp_ns < *stream.last_ns) {
      first_ = {};
      second_ = {};
      decided_.clear();
    }
    stream.last_ns = stamp_ns;
    stream.items.push_back({stamp_ns, std::move(item)});
    if (stream.items.size() > options_.capacity) stream.items.pop_front();
    return true;
  }

  /// Index of the unmatched item nearest to the stamp; the older one of two equally near.
  template <class T>
  std::optional<std::size_t> Nearest(const Stream<T>& stream, StampNs stamp_ns) const {
    std::optional<std::size_t> best;
    double best_difference = options_.max_difference_s;
    for (std::size_t i = 0; i < stream.items.size(); ++i) {
      const double difference = Difference(stream.items[i].stamp_ns, stamp_ns);
      if (difference < best_difference) {
        best = i;
        best_difference = difference;
      }
    }
    return best;
  }

  /// True when no later item of the stream can be as near to the stamp as `difference`.
  template <class T>
  static bool NothingNearerWillCome(const Stream<T>& stream, StampNs stamp_ns, double difference) {
    return *stream.last_ns >= stamp_ns && Difference(*stream.last_ns, stamp_ns) >= difference;
  }

  bool DecideOne(bool everything_has_come) {
    for (std::size_t i = 0; i < first_.items.size(); ++i) {
      const StampNs first_ns = first_.items[i].stamp_ns;
      const auto j = Nearest(second_, first_ns);
      if (!j) continue;
      const StampNs second_ns = second_.items[*j].stamp_ns;
      if (Nearest(first_, second_ns) != i) continue;
      const double difference = Difference(first_ns, second_ns);
      if (!everything_has_come && (!NothingNearerWillCome(second_, first_ns, difference) ||
                                   !NothingNearerWillCome(first_, second_ns, difference))) {
        continue;
      }
      Take(i, *j);
      return true;
    }
    return false;
  }

  void Decide(bool everything_has_come) {
    while (DecideOne(everything_has_come)) {
    }
    DropHopeless(first_, second_);
    DropHopeless(second_, first_);
  }

  /// Moves a pair to the decided ones, which are kept in the order of the first stream.
  void Take(std::size_t i, std::size_t j) {
    auto& a = first_.items[i];
    auto& b = second_.items[j];
    auto place = decided_.end();
    while (place != decided_.begin() && std::prev(place)->first_ns > a.stamp_ns) --place;
    decided_.insert(place, {a.stamp_ns, {std::move(a.value), std::move(b.value)}});
    first_.items.erase(first_.items.begin() + static_cast<std::ptrdiff_t>(i));
    second_.items.erase(second_.items.begin() + static_cast<std::ptrdiff_t>(j));
  }

  /// Drops items for which no partner is there and none can come.
  template <class T, class U>
  void DropHopeless(Stream<T>& stream, const Stream<U>& others) {
    while (!stream.items.empty() && others.last_ns) {
      const StampNs stamp_ns = stream.items.front().stamp_ns;
      if (Nearest(others, stamp_ns)) return;
      if (!NothingNearerWillCome(others, stamp_ns, options_.max_difference_s)) return;
      stream.items.pop_front();
    }
  }

  /// Takes out the decided pairs that no undecided older item of the first stream can precede.
  std::vector<Pair> TakeDecided() {
    std::vector<Pair> pairs;
    while (!decided_.empty() &&
           (first_.items.empty() || decided_.front().first_ns < first_.items.front().stamp_ns)) {
      pairs.push_back(std::move(decided_.front().pair));
      decided_.pop_front();
    }
    return pairs;
  }

  const StampMatcherOptions options_;
  Stream<First> first_;
  Stream<Second> second_;
  std::deque<Decided> decided_;
};

}  // namespace posefusion
