#pragma once

#include <Eigen/Core>

#include "posefusion/simulation/ray_packet.h"
#include "posefusion/simulation/ray_scene.h"

namespace posefusion {

/// Linear colour of a hit. `pixel_rad` is the angle between neighbouring pixels.
Rgb4 Radiance(const RayScene& scene, const Hit& hit, float incidence_cosine, float pixel_rad);

/// Cosine between the ray and the surface's normal, 0 to 1.
float IncidenceCosine(const RayScene& scene, const Hit& hit, const Eigen::Vector3f& direction);

/// Reflectance at the depth projector's wave length.
float InfraredReflectance(const RayScene& scene, const Hit& hit);

}  // namespace posefusion
