#include "posefusion/tracking/residual_kernel.h"

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

using namespace simd;

/// Normal equations in lanes.
struct LaneEquations {
  F8 a[NormalEquations::kA];
  F8 b[6];
};

/// Sums in lanes.
struct LaneSums {
  LaneEquations icp;
  LaneEquations intensity;
  F8 icp_rows, icp_squares, icp_squares_m2, icp_weights;
  F8 intensity_rows, intensity_squares, intensity_sum, intensity_weights;
};

/// Adds the row J = (g, q x g) with residual r and weight w to the normal equations.
POSEFUSION_INLINE void AddRow(F8 gx, F8 gy, F8 gz, F8 qx, F8 qy, F8 qz, F8 r, F8 w,
                              LaneEquations& sums) {
  const F8 j[6] = {gx, gy, gz, qy * gz - qz * gy, qz * gx - qx * gz, qx * gy - qy * gx};
  int k = 0;
  for (int row = 0; row < 6; ++row) {
    const F8 wj = w * j[row];
    for (int col = row; col < 6; ++col) sums.a[k++] += wj * j[col];
    sums.b[row] += wj * r;
  }
}

}  // namespace

void NormalEquations::Add(const NormalEquations& other) {
  for (int i = 0; i < kA; ++i) a[i] += other.a[i];
  for (int i = 0; i < 6; ++i) b[i] += other.b[i];
}

void ResidualSums::Add(const ResidualSums& other) {
  icp.Add(other.icp);
  intensity.Add(other.intensity);
  icp_rows += other.icp_rows;
  icp_weighted_squares += other.icp_weighted_squares;
  icp_weighted_squares_m2 += other.icp_weighted_squares_m2;
  icp_weights += other.icp_weights;
  intensity_rows += other.intensity_rows;
  intensity_weighted_squares += other.intensity_weighted_squares;
  intensity_weighted += other.intensity_weighted;
  intensity_weights += other.intensity_weights;
}

POSEFUSION_KERNEL void AccumulateResiduals(const ResidualInput& in, ResidualSums& out) {
  const F8 zero = Broadcast(0);
  const F8 one = Broadcast(1);
  const float* R = in.rotation;
  const float* t = in.translation;
  const float dof = in.student_t_dof;
  LaneSums sums{};
  for (int i = in.begin; i < in.end; i += kLanes) {
    const F8 lane = Ramp(static_cast<float>(i));
    const F8 x = Load(in.x + i), y = Load(in.y + i), z = Load(in.z + i);
    const F8 qx = x * R[0] + y * R[1] + z * R[2] + t[0];
    const F8 qy = x * R[3] + y * R[4] + z * R[5] + t[1];
    const F8 qz = x * R[6] + y * R[7] + z * R[8] + t[2];
    const I8 in_front = (lane < static_cast<float>(in.end)) & (qz > 0.05F);
    const F8 inverse_z = one / Max(qz, Broadcast(0.05F));
    const F8 slope_x = qx * inverse_z;
    const F8 slope_y = qy * inverse_z;

    // The model pixel that the point falls on.
    const F8 u = slope_x * in.fx + (in.cx + 0.5F);
    const F8 v = slope_y * in.fy + (in.cy + 0.5F);
    const I8 inside = in_front & (u >= zero) & (v >= zero) & (u < static_cast<float>(in.width)) &
                      (v < static_cast<float>(in.height));
    if (!Any(inside)) continue;
    const I8 pixel = ToInt(ZeroUnless(inside, v)) * in.width + ToInt(ZeroUnless(inside, u));
    F8 depth, nx, ny, nz, offset;
    for (int k = 0; k < kLanes; ++k) {
      const std::int32_t p = pixel[k];
      const ModelPlane& plane = in.model_planes[p];
      depth[k] = in.model_depth_m[p];
      nx[k] = plane.nx;
      ny[k] = plane.ny;
      nz[k] = plane.nz;
      offset[k] = plane.offset_m;
    }
    const I8 near = inside & (depth > zero);
    const F8 gap = Abs(depth - qz);

    if (in.use_icp) {
      const F8 fx = Load(in.nx + i), fy = Load(in.ny + i), fz = Load(in.nz + i);
      const F8 rx = fx * R[0] + fy * R[1] + fz * R[2];
      const F8 ry = fx * R[3] + fy * R[4] + fz * R[5];
      const F8 rz = fx * R[6] + fy * R[7] + fz * R[8];
      const I8 matched =
          near & (gap < in.icp_distance_m) & (rx * nx + ry * ny + rz * nz > in.icp_cosine);
      const F8 r = nx * qx + ny * qy + nz * qz - offset;
      const F8 inverse_sigma = Load(in.inverse_sigma + i);
      const F8 e = r * inverse_sigma;
      const F8 scaled = e * in.icp_inverse_scale;
      const F8 robust = ZeroUnless(matched, (dof + 1.0F) / (dof + scaled * scaled));
      const F8 to_information = inverse_sigma * in.icp_inverse_scale;
      const F8 w = robust * to_information * to_information * in.icp_information;
      AddRow(nx, ny, nz, qx, qy, qz, r, w, sums.icp);
      sums.icp_rows += ZeroUnless(matched, one);
      sums.icp_squares += robust * e * e;
      sums.icp_squares_m2 += robust * r * r;
      sums.icp_weights += robust;
    }

    if (in.use_intensity) {
      const F8 iu = slope_x * in.intensity_fx + in.intensity_cx;
      const F8 iv = slope_y * in.intensity_fy + in.intensity_cy;
      const F8 intensity = Load(in.intensity + i);
      const I8 seen = near & (gap < in.intensity_distance_m) & (intensity >= zero) & (iu >= zero) &
                      (iv >= zero) & (iu < static_cast<float>(in.intensity_width) - 0.5F) &
                      (iv < static_cast<float>(in.intensity_height) - 0.5F);
      const I8 pu = ToInt(ZeroUnless(seen, iu + 0.5F));
      const I8 pv = ToInt(ZeroUnless(seen, iv + 0.5F));
      const I8 intensity_pixel = pv * in.intensity_width + pu;
      F8 value, gradient_x, gradient_y;
      for (int k = 0; k < kLanes; ++k) {
        const ModelIntensity& model = in.model_intensity[intensity_pixel[k]];
        value[k] = model.value;
        gradient_x[k] = model.gradient_x;
        gradient_y[k] = model.gradient_y;
      }
      const F8 gradient2 = gradient_x * gradient_x + gradient_y * gradient_y;
      const I8 matched = seen & (value >= zero) & (gradient2 >= in.intensity_min_gradient2);
      // First-order interpolation between pixels.
      const F8 du = iu - __builtin_convertvector(pu, F8);
      const F8 dv = iv - __builtin_convertvector(pv, F8);
      const F8 r = value + gradient_x * du + gradient_y * dv + in.brightness - intensity;
      const F8 scaled = r * in.intensity_inverse_scale;
      const F8 robust = ZeroUnless(matched, (dof + 1.0F) / (dof + scaled * scaled));
      const F8 w = robust * (in.intensity_inverse_scale * in.intensity_inverse_scale);
      const F8 gx = gradient_x * inverse_z * in.intensity_fx;
      const F8 gy = gradient_y * inverse_z * in.intensity_fy;
      const F8 gz = -(gx * slope_x + gy * slope_y);
      AddRow(gx, gy, gz, qx, qy, qz, r, w, sums.intensity);
      sums.intensity_rows += ZeroUnless(matched, one);
      sums.intensity_squares += robust * r * r;
      sums.intensity_sum += robust * r;
      sums.intensity_weights += robust;
    }
  }
  for (int k = 0; k < NormalEquations::kA; ++k) {
    out.icp.a[k] = Sum(sums.icp.a[k]);
    out.intensity.a[k] = Sum(sums.intensity.a[k]);
  }
  for (int k = 0; k < 6; ++k) {
    out.icp.b[k] = Sum(sums.icp.b[k]);
    out.intensity.b[k] = Sum(sums.intensity.b[k]);
  }
  out.icp_rows = Sum(sums.icp_rows);
  out.icp_weighted_squares = Sum(sums.icp_squares);
  out.icp_weighted_squares_m2 = Sum(sums.icp_squares_m2);
  out.icp_weights = Sum(sums.icp_weights);
  out.intensity_rows = Sum(sums.intensity_rows);
  out.intensity_weighted_squares = Sum(sums.intensity_squares);
  out.intensity_weighted = Sum(sums.intensity_sum);
  out.intensity_weights = Sum(sums.intensity_weights);
}

}  // namespace posefusion
