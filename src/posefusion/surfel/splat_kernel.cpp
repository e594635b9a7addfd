#include "posefusion/surfel/splat_kernel.h"

#include "posefusion/common/simd.h"

namespace posefusion {

using namespace simd;

POSEFUSION_KERNEL void ProjectSurfels(const SplatProjection& in, const SplatSurfels& s, float* u,
                                      float* v, float* z, float* reach_px) {
  const F8 zero = Broadcast(0);
  const float* R = in.rotation;
  const float* t = in.translation;
  for (int i = 0; i < s.size; i += kLanes) {
    const F8 mx = Load(s.x + i) - t[0];
    const F8 my = Load(s.y + i) - t[1];
    const F8 mz = Load(s.z + i) - t[2];
    const F8 px = mx * R[0] + my * R[3] + mz * R[6];
    const F8 py = mx * R[1] + my * R[4] + mz * R[7];
    const F8 pz = mx * R[2] + my * R[5] + mz * R[8];
    const F8 inverse_z = Broadcast(1) / Max(pz, Broadcast(in.nearest_m));
    const F8 pu = px * inverse_z * in.fx + in.cx;
    const F8 pv = py * inverse_z * in.fy + in.cy;
    const F8 radius = Load(s.radius + i);
    const F8 facing = mx * Load(s.nx + i) + my * Load(s.ny + i) + mz * Load(s.nz + i);
    // A disc seen at the image's border is stretched; 1.2 covers the corners of a 60 degree view.
    const F8 reach = Max(radius * inverse_z * (in.fx * 1.2F), Broadcast(in.min_footprint_px));
    I8 last_seen;
    std::memcpy(&last_seen, s.last_seen + i, sizeof last_seen);
    const I8 drawn = (radius > zero) & (last_seen >= in.first_active_frame) & (pz > in.nearest_m) &
                     (facing < zero) & (pu > -reach) & (pv > -reach) &
                     (pu < static_cast<float>(in.width) + reach) &
                     (pv < static_cast<float>(in.height) + reach);
    Store(u + i, pu);
    Store(v + i, pv);
    Store(z + i, pz);
    Store(reach_px + i, ZeroUnless(drawn, reach));
  }
}

}  // namespace posefusion
