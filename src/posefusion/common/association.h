#pragma once

#include <cstddef>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// Indices of two entries that belong to the same moment.
struct StampMatch {
  std::size_t first = 0;
  std::size_t second = 0;
};

/// Pairs the entries of two lists whose stamps differ by less than `max_difference_s`, each entry
/// at most once and the closest pairs first, as the associate script of the TUM RGB-D benchmark
/// does (Sturm 2012). Both lists may be in any order; the matches come in the order of the first
/// list's stamps.
std::vector<StampMatch> AssociateStamps(const std::vector<StampNs>& first_ns,
                                        const std::vector<StampNs>& second_ns,
                                        double max_difference_s);

}  // namespace posefusion
