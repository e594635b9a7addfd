#pragma once

#include "posefusion/common/parallel.h"
#include "posefusion/image/grid.h"

namespace posefusion {

/// Intensity below 0 means that a pixel is masked, or that nothing is known of it.
constexpr float kNoIntensity = -1;

/// The mean of each 2x2 block of `fine`; none where one of the four is missing. `coarse` is resized
/// to half the size, odd last rows and columns are left out.
void HalveIntensity(const Grid<float>& fine, const ParallelRunner& parallel, Grid<float>& coarse);

}  // namespace posefusion
