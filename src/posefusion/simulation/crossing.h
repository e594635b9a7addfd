#pragma once

#include "posefusion/simulation/script.h"

namespace posefusion {

/// How near before the camera somebody passes.
enum class CrossingKind {
  kNear,   ///< half a metre to a metre
  kClose,  ///< a third of a metre, and stops there: the picture shows hardly anything else
};

/// Goes to the camera within some seconds and through its picture from one side to the other, as
/// near as there is room. False, and nothing is done, when there is no way.
bool Cross(CrossingKind kind, const Stage& stage, double speed, Script& script);

}  // namespace posefusion
