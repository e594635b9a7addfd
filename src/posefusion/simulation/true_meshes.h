#pragma once

#include <vector>

#include "posefusion/dataset/moved_objects_file.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Everything that keeps its place during the run, things that could be moved but are not among it.
/// Map frame.
TriangleMesh UnmovedSurfaces(const World& world);

/// What is moved during the run, where it rests before and after.
std::vector<MovedSurfaces> MovedSurfacesOf(const World& world);

}  // namespace posefusion
