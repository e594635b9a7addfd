#include "posefusion/surfel/surfel_chunk.h"

namespace posefusion {

Eigen::Vector3f SurfelChunk::Position(int slot) const {
  const auto i = static_cast<std::size_t>(slot);
  return {x[i], y[i], z[i]};
}

Surfel SurfelChunk::Get(int slot) const {
  const auto i = static_cast<std::size_t>(slot);
  Surfel surfel;
  surfel.position_m = {x[i], y[i], z[i]};
  surfel.normal = {nx[i], ny[i], nz[i]};
  surfel.rgb = {red[i], green[i], blue[i]};
  surfel.radius_m = radius[i];
  surfel.confidence = confidence[i];
  surfel.first_seen = first_seen[i];
  surfel.last_seen = last_seen[i];
  surfel.id = id[i];
  return surfel;
}

void SurfelChunk::Set(int slot, const Surfel& surfel) {
  const auto i = static_cast<std::size_t>(slot);
  x[i] = surfel.position_m.x();
  y[i] = surfel.position_m.y();
  z[i] = surfel.position_m.z();
  nx[i] = surfel.normal.x();
  ny[i] = surfel.normal.y();
  nz[i] = surfel.normal.z();
  red[i] = surfel.rgb.x();
  green[i] = surfel.rgb.y();
  blue[i] = surfel.rgb.z();
  radius[i] = surfel.radius_m;
  confidence[i] = surfel.confidence;
  first_seen[i] = surfel.first_seen;
  last_seen[i] = surfel.last_seen;
  id[i] = surfel.id;
}

}  // namespace posefusion
