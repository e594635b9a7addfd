#pragma once

#include <posefusion/Status.h>

#include "posefusion_ros/nodelets/diagnostics.h"

namespace posefusion {

/// The parts of Status as /diagnostics shows them; each fills one entry.
void DescribeFrames(const Status& status, Diagnostics::Wrapper& entry);
void DescribeTracking(const Status& status, Diagnostics::Wrapper& entry);
void DescribeTf(const Status& status, Diagnostics::Wrapper& entry);
void DescribePeople(const Status& status, Diagnostics::Wrapper& entry);
void DescribeStages(const Status& status, Diagnostics::Wrapper& entry);

}  // namespace posefusion
