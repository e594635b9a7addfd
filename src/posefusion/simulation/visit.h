#pragma once

#include "posefusion/simulation/script.h"

namespace posefusion {

/// Goes to a place in the view of the camera that lies on the floor, stands there and looks at it,
/// within the time of the visit. False, and nothing is done, when there is no way in time.
bool VisitCamera(const CameraVisit& visit, const Stage& stage, double speed, Script& script);

}  // namespace posefusion
