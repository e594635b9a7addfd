#include "posefusion/image/normals.h"

#include <algorithm>

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

using namespace simd;

constexpr int kRowsPerBlock = 16;

struct NormalRow {
  const float* left;
  const float* right;
  const float* centre;
  const float* up;
  const float* down;
  float* nx;
  float* ny;
  float* nz;
  int begin, end;  ///< columns
  int step;
  float inverse_fx, cx;
  float ray_y_up, ray_y, ray_y_down;
  float sigma_base, sigma_growth, sigma_offset;
  float slope;  ///< allowed depth difference per metre of depth
};

POSEFUSION_KERNEL void ComputeRow(const NormalRow& row) {
  const F8 zero = Broadcast(0);
  for (int x = row.begin; x < row.end; x += kLanes) {
    const F8 z = Load(row.centre + x);
    const F8 zl = Load(row.left + x);
    const F8 zr = Load(row.right + x);
    const F8 zu = Load(row.up + x);
    const F8 zd = Load(row.down + x);
    const F8 ray_x = (Ramp(static_cast<float>(x)) - row.cx) * row.inverse_fx;
    const F8 offset_x = Broadcast(static_cast<float>(row.step) * row.inverse_fx);
    const F8 from_offset = z - row.sigma_offset;
    const F8 gate =
        Max(row.sigma_base + row.sigma_growth * from_offset * from_offset, row.slope * z);
    const I8 valid = (z > zero) & (zl > zero) & (zr > zero) & (zu > zero) & (zd > zero) &
                     (Abs(zl - z) < gate) & (Abs(zr - z) < gate) & (Abs(zu - z) < gate) &
                     (Abs(zd - z) < gate);
    // Tangents along the row (a) and down the column (b).
    const F8 ax = (ray_x + offset_x) * zr - (ray_x - offset_x) * zl;
    const F8 ay = row.ray_y * (zr - zl);
    const F8 az = zr - zl;
    const F8 bx = ray_x * (zd - zu);
    const F8 by = row.ray_y_down * zd - row.ray_y_up * zu;
    const F8 bz = zd - zu;
    // b x a points towards the camera (x right, y down, z forward).
    const F8 nx = by * az - bz * ay;
    const F8 ny = bz * ax - bx * az;
    const F8 nz = bx * ay - by * ax;
    const F8 length2 = Max(nx * nx + ny * ny + nz * nz, Broadcast(1e-30F));
    const F8 inverse = ZeroUnless(valid, Broadcast(1) / Sqrt(length2));
    Store(row.nx + x, nx * inverse);
    Store(row.ny + x, ny * inverse);
    Store(row.nz + x, nz * inverse);
  }
}

}  // namespace

void ComputeNormals(const Grid<float>& depth_m, const CameraModel& camera,
                    const NormalConfig& config, const DepthNoiseConfig& noise,
                    const ParallelRunner& parallel, NormalMap& normals) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  const int step = config.step_px;
  normals.Resize(width, height);
  const auto ray_y = [&](int y) { return static_cast<float>((y - camera.cy) / camera.fy); };
  parallel.ForEachRange(height, kRowsPerBlock, [&](int begin, int end) {
    // A row is computed in whole SIMD groups into spare memory, then copied without its margins.
    const auto padded = static_cast<std::size_t>(width + kLanes);
    std::vector<float> nx(padded), ny(padded), nz(padded);
    for (int y = begin; y < end; ++y) {
      std::fill_n(normals.x.row(y), width, 0.0F);
      std::fill_n(normals.y.row(y), width, 0.0F);
      std::fill_n(normals.z.row(y), width, 0.0F);
      if (y < step || y >= height - step || width <= 2 * step) continue;
      const float* centre = depth_m.row(y);
      NormalRow row{};
      row.left = centre - step;
      row.right = centre + step;
      row.centre = centre;
      row.up = depth_m.row(y - step);
      row.down = depth_m.row(y + step);
      row.nx = nx.data();
      row.ny = ny.data();
      row.nz = nz.data();
      row.begin = step;
      row.end = width - step;
      row.step = step;
      row.inverse_fx = static_cast<float>(1 / camera.fx);
      row.cx = static_cast<float>(camera.cx);
      row.ray_y_up = ray_y(y - step);
      row.ray_y = ray_y(y);
      row.ray_y_down = ray_y(y + step);
      row.sigma_base = static_cast<float>(config.max_jump_sigmas * noise.base_m);
      row.sigma_growth = static_cast<float>(config.max_jump_sigmas * noise.growth_per_m);
      row.sigma_offset = static_cast<float>(noise.offset_m);
      row.slope = static_cast<float>(config.max_slope * step / camera.fx);
      ComputeRow(row);
      const auto count = width - 2 * step;
      std::copy_n(nx.begin() + step, count, normals.x.row(y) + step);
      std::copy_n(ny.begin() + step, count, normals.y.row(y) + step);
      std::copy_n(nz.begin() + step, count, normals.z.row(y) + step);
    }
  });
}

}  // namespace posefusion
