#pragma once

#include <map>
#include <utility>
#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Keypoints on their way: they come out when their time of arrival has come. Not thread-safe.
class ArrivalQueue {
 public:
  void Add(Skeletons skeletons) {
    const StampNs arrival_ns = skeletons.arrival_ns;
    waiting_.emplace(arrival_ns, std::move(skeletons));
  }

  /// Those that have arrived by `now_ns`, in order of arrival; of equal times the first added
  /// first.
  std::vector<Skeletons> Take(StampNs now_ns) {
    std::vector<Skeletons> arrived;
    const auto end = waiting_.upper_bound(now_ns);
    for (auto it = waiting_.begin(); it != end; ++it) arrived.push_back(std::move(it->second));
    waiting_.erase(waiting_.begin(), end);
    return arrived;
  }

 private:
  std::multimap<StampNs, Skeletons> waiting_;
};

}  // namespace posefusion
