#include "posefusion/surfel/fusion_kernel.h"

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

using namespace simd;

/// Measurements at the pixels of eight surfels.
struct Measured {
  F8 depth, nearest, nx, ny, nz;
};

POSEFUSION_INLINE Measured Gather(const FusionKernelInput& in, I8 pixel) {
  Measured m;
  for (int i = 0; i < kLanes; ++i) {
    const std::int32_t p = pixel[i];
    m.depth[i] = in.depth_m[p];
    m.nearest[i] = in.nearest_around_m[p];
    m.nx[i] = in.normal_x[p];
    m.ny[i] = in.normal_y[p];
    m.nz[i] = in.normal_z[p];
  }
  return m;
}

/// Colours at the pixels nearest to (u, v), for lanes where that lies in the image.
struct Colors {
  F8 red, green, blue;
};

POSEFUSION_INLINE Colors GatherColors(const FusionKernelInput& in, I8 pixel) {
  Colors c;
  for (int i = 0; i < kLanes; ++i) {
    const std::uint8_t* rgb = in.rgb + 3 * pixel[i];
    c.red[i] = static_cast<float>(rgb[0]);
    c.green[i] = static_cast<float>(rgb[1]);
    c.blue[i] = static_cast<float>(rgb[2]);
  }
  return c;
}

POSEFUSION_INLINE I8 LoadInt(const std::uint32_t* p) {
  I8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// exp(-x) for x in [0, 8] by a rational approximation, exact enough for a weight (1e-3).
POSEFUSION_INLINE F8 ExpMinus(F8 x) {
  const F8 e = Broadcast(1) + x * (1.0F / 16);
  const F8 e2 = e * e;
  const F8 e4 = e2 * e2;
  const F8 e8 = e4 * e4;
  return Broadcast(1) / (e8 * e8);
}

}  // namespace

POSEFUSION_KERNEL FusionKernelCounts UpdateSurfels(const FusionKernelInput& in,
                                                   const FusionKernelSurfels& s) {
  const F8 zero = Broadcast(0);
  const F8 one = Broadcast(1);
  const float* R = in.rotation;
  const float* t = in.translation;
  I8 updated_count{}, removed_count{}, unstable_count{};
  for (int i = 0; i < s.size; i += kLanes) {
    const F8 radius = Load(s.radius + i);
    const I8 alive = radius > zero;
    if (!Any(alive)) continue;
    const F8 mx = Load(s.x + i) - t[0];
    const F8 my = Load(s.y + i) - t[1];
    const F8 mz = Load(s.z + i) - t[2];
    const F8 px = mx * R[0] + my * R[3] + mz * R[6];
    const F8 py = mx * R[1] + my * R[4] + mz * R[7];
    const F8 pz = mx * R[2] + my * R[5] + mz * R[8];
    const F8 depth_safe = Max(pz, Broadcast(0.05F));
    const F8 inverse_z = one / depth_safe;
    const F8 u = px * inverse_z * in.fx + in.cx;
    const F8 v = py * inverse_z * in.fy + in.cy;
    const F8 confidence = Load(s.confidence + i);
    const I8 last_seen = LoadInt(s.last_seen + i);
    const I8 active = last_seen >= in.first_active_frame;
    const I8 unstable = confidence < in.stable_confidence;
    const I8 stale = alive & active & unstable & (last_seen < in.first_fresh_frame);
    const I8 in_view = alive & active & (pz > in.min_depth_m) & (pz < in.max_depth_m) & (u > 0.5F) &
                       (u < static_cast<float>(in.width) - 1.5F) & (v > 0.5F) &
                       (v < static_cast<float>(in.height) - 1.5F);
    if (!Any(in_view)) {
      for (int k = 0; k < kLanes; ++k) {
        if (stale[k]) s.radius[i + k] = s.confidence[i + k] = 0;
      }
      removed_count += stale;
      unstable_count += alive & unstable & ~stale;
      continue;
    }
    const I8 ui = ToInt(Select(in_view, u + 0.5F, zero));
    const I8 vi = ToInt(Select(in_view, v + 0.5F, zero));
    const I8 pixel = vi * in.width + ui;
    const Measured m = Gather(in, pixel);

    const F8 ray_x = (__builtin_convertvector(ui, F8) - in.cx) / in.fx;
    const F8 ray_y = (__builtin_convertvector(vi, F8) - in.cy) / in.fy;
    const F8 from_offset = m.depth - in.sigma_offset;
    const F8 sigma = in.sigma_base + in.sigma_growth * from_offset * from_offset;
    // The surfel's normal in the camera frame, and how the measured surface faces the camera.
    const F8 snx = Load(s.nx + i), sny = Load(s.ny + i), snz = Load(s.nz + i);
    const F8 cnx = snx * R[0] + sny * R[3] + snz * R[6];
    const F8 cny = snx * R[1] + sny * R[4] + snz * R[7];
    const F8 cnz = snx * R[2] + sny * R[5] + snz * R[8];
    const F8 ray_length = Sqrt(ray_x * ray_x + ray_y * ray_y + 1.0F);
    const F8 facing = -(m.nx * ray_x + m.ny * ray_y + m.nz) / ray_length;
    const I8 has_depth = in_view & (m.depth > zero);
    const F8 normals_agree = cnx * m.nx + cny * m.ny + cnz * m.nz;
    // Distance to the measured plane, along its normal.
    const F8 plane =
        m.nx * (ray_x * m.depth - px) + m.ny * (ray_y * m.depth - py) + m.nz * (m.depth - pz);
    const F8 gate = Max(Broadcast(in.association_distance_m), sigma * in.association_sigmas);
    const I8 matched = has_depth & (facing > in.grazing_cosine) & (Abs(plane) < gate) &
                       (Abs(pz - m.depth) < gate + gate) & (normals_agree > in.association_cosine);

    // Weight of the measurement, largest in the middle of the image (Keller 2013, section 4.1).
    const F8 dx = __builtin_convertvector(ui, F8) - in.cx;
    const F8 dy = __builtin_convertvector(vi, F8) - in.cy;
    const F8 weight = in.frame_weight * ExpMinus((dx * dx + dy * dy) * in.inverse_falloff);
    const F8 measured_radius = m.depth * in.radius_scale / Max(facing, Broadcast(0.5F));
    const I8 fine = matched & (measured_radius < radius * in.max_radius_growth);
    const F8 total = confidence + weight;
    const F8 share = ZeroUnless(fine, weight / total);
    const F8 along = share * plane;
    Store(s.x + i, Load(s.x + i) + along * (R[0] * m.nx + R[1] * m.ny + R[2] * m.nz));
    Store(s.y + i, Load(s.y + i) + along * (R[3] * m.nx + R[4] * m.ny + R[5] * m.nz));
    Store(s.z + i, Load(s.z + i) + along * (R[6] * m.nx + R[7] * m.ny + R[8] * m.nz));
    const F8 bx = snx + share * (R[0] * m.nx + R[1] * m.ny + R[2] * m.nz - snx);
    const F8 by = sny + share * (R[3] * m.nx + R[4] * m.ny + R[5] * m.nz - sny);
    const F8 bz = snz + share * (R[6] * m.nx + R[7] * m.ny + R[8] * m.nz - snz);
    const F8 inverse_length = one / Sqrt(Max(bx * bx + by * by + bz * bz, Broadcast(1e-12F)));
    Store(s.nx + i, Select(fine, bx * inverse_length, snx));
    Store(s.ny + i, Select(fine, by * inverse_length, sny));
    Store(s.nz + i, Select(fine, bz * inverse_length, snz));
    // The colour image was taken from a slightly different place.
    const float* C = in.color_rotation;
    const F8 wx = px * C[0] + py * C[1] + pz * C[2] + in.color_translation[0];
    const F8 wy = px * C[3] + py * C[4] + pz * C[5] + in.color_translation[1];
    const F8 wz = px * C[6] + py * C[7] + pz * C[8] + in.color_translation[2];
    const F8 inverse_wz = one / Max(wz, Broadcast(0.05F));
    const F8 cu = wx * inverse_wz * in.fx + (in.cx + 0.5F);
    const F8 cv = wy * inverse_wz * in.fy + (in.cy + 0.5F);
    const I8 has_color = in_view & (cu >= zero) & (cv >= zero) &
                         (cu < static_cast<float>(in.width)) & (cv < static_cast<float>(in.height));
    const Colors m_color = GatherColors(
        in, ToInt(ZeroUnless(has_color, cv)) * in.width + ToInt(ZeroUnless(has_color, cu)));
    const F8 color_share = ZeroUnless(has_color, Min(share * in.color_rate, one));
    const F8 red = Load(s.red + i), green = Load(s.green + i), blue = Load(s.blue + i);
    Store(s.red + i, red + color_share * (m_color.red - red));
    Store(s.green + i, green + color_share * (m_color.green - green));
    Store(s.blue + i, blue + color_share * (m_color.blue - blue));

    // The measured surface and all around it lie behind the surfel: it is not there any more.
    const F8 free_gate = Max(Broadcast(in.free_space_distance_m), sigma * in.free_space_sigmas);
    const I8 contradicted = has_depth & ~matched & (m.nearest - pz > free_gate);
    const F8 lost = ZeroUnless(contradicted, weight * in.free_space_weight);
    const F8 gained = ZeroUnless(matched, weight);
    F8 new_confidence = Min(confidence + gained, Max(confidence, Broadcast(in.max_confidence)));
    new_confidence = new_confidence - lost;
    const I8 removed =
        (contradicted & (new_confidence <= zero)) | (contradicted & unstable) | (stale & ~matched);
    const F8 new_radius = radius + share * (measured_radius - radius);
    Store(s.confidence + i, ZeroUnless(~removed, new_confidence));
    Store(s.radius + i, ZeroUnless(~removed, Select(fine, new_radius, radius)));
    for (int k = 0; k < kLanes; ++k) {
      if (!matched[k]) continue;
      s.last_seen[i + k] = static_cast<std::uint32_t>(in.frame);
      // Two threads may claim the same pixel with the same value.
      __atomic_store_n(in.claimed + pixel[k], static_cast<std::uint8_t>(1), __ATOMIC_RELAXED);
    }
    updated_count += matched;
    removed_count += removed;
    unstable_count += alive & ~removed & (new_confidence < in.stable_confidence);
  }
  FusionKernelCounts counts;
  for (int k = 0; k < kLanes; ++k) {
    counts.updated -= updated_count[k];
    counts.removed -= removed_count[k];
    counts.unstable -= unstable_count[k];
  }
  return counts;
}

}  // namespace posefusion
