#pragma once

#include <cstdlib>
#include <iterator>
#include <map>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// The entry whose stamp is nearest, the earlier of two equally near; end() of an empty map.
template <class Map>
auto NearestStamp(Map& by_stamp, StampNs stamp_ns) {
  const auto after = by_stamp.lower_bound(stamp_ns);
  if (after == by_stamp.begin()) return after;
  const auto before = std::prev(after);
  if (after == by_stamp.end()) return before;
  return stamp_ns - before->first <= after->first - stamp_ns ? before : after;
}

/// The nearest entry less than `limit_ns` away, or end().
template <class Map>
auto FindStamp(Map& by_stamp, StampNs stamp_ns, StampNs limit_ns) {
  const auto nearest = NearestStamp(by_stamp, stamp_ns);
  const bool near = nearest != by_stamp.end() && std::llabs(nearest->first - stamp_ns) < limit_ns;
  return near ? nearest : by_stamp.end();
}

}  // namespace posefusion
