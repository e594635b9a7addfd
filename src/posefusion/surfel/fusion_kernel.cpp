#include "posefusion/surfel/fusion_kernel.h"

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

using namespace simd;

/// Eight surfels of a chunk, from slot `first` on.
struct Lanes {
  F8 x, y, z, nx, ny, nz, radius, confidence;
  I8 last_seen;
};

POSEFUSION_INLINE Lanes LoadLanes(const FusionKernelSurfels& s, int first) {
  Lanes l;
  l.x = Load(s.x + first);
  l.y = Load(s.y + first);
  l.z = Load(s.z + first);
  l.nx = Load(s.nx + first);
  l.ny = Load(s.ny + first);
  l.nz = Load(s.nz + first);
  l.radius = Load(s.radius + first);
  l.confidence = Load(s.confidence + first);
  std::memcpy(&l.last_seen, s.last_seen + first, sizeof l.last_seen);
  return l;
}

struct Vector {
  F8 x, y, z;
};

POSEFUSION_INLINE F8 Dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// R v for a matrix stored row by row.
POSEFUSION_INLINE Vector Rotate(const float* R, const Vector& v) {
  return {R[0] * v.x + R[1] * v.y + R[2] * v.z, R[3] * v.x + R[4] * v.y + R[5] * v.z,
          R[6] * v.x + R[7] * v.y + R[8] * v.z};
}

/// R^T v.
POSEFUSION_INLINE Vector RotateBack(const float* R, const Vector& v) {
  return {v.x * R[0] + v.y * R[3] + v.z * R[6], v.x * R[1] + v.y * R[4] + v.z * R[7],
          v.x * R[2] + v.y * R[5] + v.z * R[8]};
}

/// Where points of the camera frame fall: rounded pixel and whether that is in the image.
struct PixelLanes {
  I8 u, v;
  I8 inside;
};

POSEFUSION_INLINE PixelLanes ProjectLanes(const FusionKernelInput& in, const Vector& p,
                                          float margin) {
  const F8 inverse_z = Broadcast(1) / Max(p.z, Broadcast(in.min_depth_m));
  const F8 u = p.x * inverse_z * in.fx + (in.cx + 0.5F);
  const F8 v = p.y * inverse_z * in.fy + (in.cy + 0.5F);
  PixelLanes pixel;
  pixel.inside = (p.z > in.min_depth_m) & (u >= margin) & (v >= margin) &
                 (u < static_cast<float>(in.width) - margin) &
                 (v < static_cast<float>(in.height) - margin);
  pixel.u = ToInt(ZeroUnless(pixel.inside, u));
  pixel.v = ToInt(ZeroUnless(pixel.inside, v));
  return pixel;
}

/// Measurements at eight pixels, camera frame.
struct Measured {
  F8 depth, nearest, sigma;
  Vector point, normal;
  F8 facing;  ///< cosine between the normal and the direction to the camera
  F8 weight;
};

/// Weight of a measurement, largest in the middle of the image (Keller et al. 2013, section 4.1).
/// exp(-x) for x in [0, 8] by (1 + x / 16)^-16, exact enough for a weight.
POSEFUSION_INLINE F8 CentreWeight(const FusionKernelInput& in, F8 u, F8 v) {
  const F8 dx = u - in.cx;
  const F8 dy = v - in.cy;
  const F8 x = (dx * dx + dy * dy) * in.inverse_falloff;
  const F8 e = Broadcast(1) + x * (1.0F / 16);
  const F8 e2 = e * e;
  const F8 e4 = e2 * e2;
  const F8 e8 = e4 * e4;
  return in.frame_weight / (e8 * e8);
}

POSEFUSION_INLINE Measured Measure(const FusionKernelInput& in, const PixelLanes& pixel, I8 index) {
  Measured m;
  for (int i = 0; i < kLanes; ++i) {
    const std::int32_t k = index[i];
    m.depth[i] = in.depth_m[k];
    m.nearest[i] = in.nearest_around_m[k];
    m.normal.x[i] = in.normal_x[k];
    m.normal.y[i] = in.normal_y[k];
    m.normal.z[i] = in.normal_z[k];
  }
  const F8 u = __builtin_convertvector(pixel.u, F8);
  const F8 v = __builtin_convertvector(pixel.v, F8);
  const Vector ray = {(u - in.cx) / in.fx, (v - in.cy) / in.fy, Broadcast(1)};
  m.point = {ray.x * m.depth, ray.y * m.depth, m.depth};
  m.facing = -Dot(m.normal, ray) / Sqrt(Dot(ray, ray));
  const F8 from_offset = m.depth - in.sigma_offset;
  m.sigma = in.sigma_base + in.sigma_growth * from_offset * from_offset;
  m.weight = CentreWeight(in, u, v);
  return m;
}

/// What a measurement means for a surfel.
struct Verdict {
  I8 matched;       ///< the same surface
  I8 contradicted;  ///< the camera looks through the surfel
  F8 plane;         ///< distance from the surfel to the measured plane along its normal
};

POSEFUSION_INLINE Verdict Compare(const FusionKernelInput& in, const Vector& p,
                                  const Vector& normal, const Measured& m, I8 in_view) {
  const I8 has_depth = in_view & (m.depth > Broadcast(0));
  const F8 gate = Max(Broadcast(in.association_distance_m), m.sigma * in.association_sigmas);
  const F8 free_gate = Max(Broadcast(in.free_space_distance_m), m.sigma * in.free_space_sigmas);
  Verdict verdict;
  verdict.plane = Dot(m.normal, {m.point.x - p.x, m.point.y - p.y, m.point.z - p.z});
  verdict.matched = has_depth & (m.facing > in.grazing_cosine) & (Abs(verdict.plane) < gate) &
                    (Abs(p.z - m.depth) < gate + gate) &
                    (Dot(normal, m.normal) > in.association_cosine);
  // Every surface around lies behind the surfel.
  verdict.contradicted =
      in_view & ~verdict.matched & (m.nearest > Broadcast(0)) & (m.nearest - p.z > free_gate);
  return verdict;
}

/// Moves position and normal by `share` of their distance to the measurement.
POSEFUSION_INLINE void BlendGeometry(const FusionKernelInput& in, const Lanes& lanes,
                                     const Measured& m, F8 plane, F8 share, int first,
                                     const FusionKernelSurfels& s) {
  const Vector n = Rotate(in.rotation, m.normal);
  const F8 along = share * plane;
  Store(s.x + first, lanes.x + along * n.x);
  Store(s.y + first, lanes.y + along * n.y);
  Store(s.z + first, lanes.z + along * n.z);
  const Vector blend = {lanes.nx + share * (n.x - lanes.nx), lanes.ny + share * (n.y - lanes.ny),
                        lanes.nz + share * (n.z - lanes.nz)};
  const F8 inverse = Broadcast(1) / Sqrt(Max(Dot(blend, blend), Broadcast(1e-12F)));
  const I8 moves = share > Broadcast(0);
  Store(s.nx + first, Select(moves, blend.x * inverse, lanes.nx));
  Store(s.ny + first, Select(moves, blend.y * inverse, lanes.ny));
  Store(s.nz + first, Select(moves, blend.z * inverse, lanes.nz));
}

/// Moves colours by `share` towards those of the colour image, which was taken from a slightly
/// different place.
POSEFUSION_INLINE void BlendColor(const FusionKernelInput& in, const Vector& p, F8 share, int first,
                                  const FusionKernelSurfels& s) {
  const float* t = in.color_translation;
  const Vector turned = Rotate(in.color_rotation, p);
  const PixelLanes pixel = ProjectLanes(in, {turned.x + t[0], turned.y + t[1], turned.z + t[2]}, 0);
  const I8 index = pixel.v * in.width + pixel.u;
  const F8 color_share = ZeroUnless(pixel.inside, Min(share * in.color_rate, Broadcast(1)));
  float* const channels[3] = {s.red + first, s.green + first, s.blue + first};
  for (int c = 0; c < 3; ++c) {
    F8 measured = Broadcast(0);
    for (int i = 0; i < kLanes; ++i) measured[i] = static_cast<float>(in.rgb[3 * index[i] + c]);
    const F8 stored = Load(channels[c]);
    Store(channels[c], stored + color_share * (measured - stored));
  }
}

POSEFUSION_INLINE void MarkSeen(const FusionKernelInput& in, I8 matched, I8 index, int first,
                                const FusionKernelSurfels& s) {
  for (int k = 0; k < kLanes; ++k) {
    if (!matched[k]) continue;
    s.last_seen[first + k] = static_cast<std::uint32_t>(in.frame);
    // Two threads may claim the same pixel with the same value.
    __atomic_store_n(in.claimed + index[k], static_cast<std::uint8_t>(1), __ATOMIC_RELAXED);
  }
}

}  // namespace

POSEFUSION_KERNEL FusionKernelCounts UpdateSurfels(const FusionKernelInput& in,
                                                   const FusionKernelSurfels& s) {
  const F8 zero = Broadcast(0);
  const float* t = in.translation;
  I8 updated_count{}, removed_count{}, unstable_count{};
  for (int i = 0; i < s.size; i += kLanes) {
    const Lanes lanes = LoadLanes(s, i);
    const I8 alive = lanes.radius > zero;
    if (!Any(alive)) continue;
    const I8 active = alive & (lanes.last_seen >= in.first_active_frame);
    const I8 unstable = lanes.confidence < in.stable_confidence;
    const I8 stale = active & unstable & (lanes.last_seen < in.first_fresh_frame);
    const Vector p = RotateBack(in.rotation, {lanes.x - t[0], lanes.y - t[1], lanes.z - t[2]});
    const PixelLanes pixel = ProjectLanes(in, p, 1);
    const I8 in_view = active & pixel.inside;

    const I8 index = pixel.v * in.width + pixel.u;
    const Measured m = Measure(in, pixel, index);
    const Vector normal = RotateBack(in.rotation, {lanes.nx, lanes.ny, lanes.nz});
    const Verdict verdict = Compare(in, p, normal, m, in_view);

    // Weighted means (Keller et al. 2013, eq. 4-6); coarse measurements only confirm.
    const F8 measured_radius = m.depth * in.radius_scale / Max(m.facing, Broadcast(0.5F));
    const I8 fine = verdict.matched & (measured_radius < lanes.radius * in.max_radius_growth);
    const F8 share = ZeroUnless(fine, m.weight / (lanes.confidence + m.weight));
    BlendGeometry(in, lanes, m, verdict.plane, share, i, s);
    BlendColor(in, p, share, i, s);
    MarkSeen(in, verdict.matched, index, i, s);

    const F8 limit = Max(lanes.confidence, Broadcast(in.max_confidence));
    const F8 gained = ZeroUnless(verdict.matched, m.weight);
    const F8 lost = ZeroUnless(verdict.contradicted, m.weight * in.free_space_weight);
    const F8 confidence = Min(lanes.confidence + gained, limit) - lost;
    const I8 removed =
        (verdict.contradicted & (unstable | (confidence <= zero))) | (stale & ~verdict.matched);
    const F8 radius = lanes.radius + share * (measured_radius - lanes.radius);
    Store(s.confidence + i, ZeroUnless(~removed, confidence));
    Store(s.radius + i, ZeroUnless(~removed, radius));
    updated_count += verdict.matched;
    removed_count += removed;
    unstable_count += alive & ~removed & (confidence < in.stable_confidence);
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
