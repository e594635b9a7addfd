#pragma once

#include <vector>

namespace posefusion {

/// Summary of error magnitudes, in the unit of the errors. All zero when there are none.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0;
  double mean = 0;
  double median = 0;  ///< mean of the middle two for an even count
  double p95 = 0;     ///< nearest rank
  double std_dev = 0;
  double min = 0;
  double max = 0;
};

ErrorStatistics Summarize(const std::vector<double>& errors);

}  // namespace posefusion
