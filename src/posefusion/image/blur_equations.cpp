#include "posefusion/image/blur_equations.h"

#include <array>
#include <opencv2/core.hpp>

#include "posefusion/common/simd.h"

namespace posefusion {
namespace {

constexpr int kUnknowns = 5;
constexpr int kProducts = kUnknowns * (kUnknowns + 1) / 2;
constexpr int kSums = kProducts + kUnknowns + 1;
constexpr double kDark = 1;  ///< grey levels

struct Patch {
  const float* before;
  const float* now;
  std::size_t before_step;  ///< floats from row to row
  std::size_t now_step;
  int columns;
  int rows;
};

/// The mean of both images, with equal brightness, at a pixel and around it.
struct Neighbourhood {
  const float* before;
  const float* now;
  std::ptrdiff_t before_step;
  std::ptrdiff_t now_step;
  simd::F8 gain;

  POSEFUSION_INLINE simd::F8 Before(int dv, int du) const {
    return gain * simd::Load(before + dv * before_step + du);
  }
  POSEFUSION_INLINE simd::F8 Now(int dv, int du) const {
    return simd::Load(now + dv * now_step + du);
  }
  POSEFUSION_INLINE simd::F8 Twice(int dv, int du) const { return Before(dv, du) + Now(dv, du); }
};

POSEFUSION_INLINE void AddPixels(const Neighbourhood& at, simd::F8* sums) {
  const simd::F8 middle = at.Twice(0, 0);
  const simd::F8 left = at.Twice(0, -1);
  const simd::F8 right = at.Twice(0, 1);
  const simd::F8 above = at.Twice(-1, 0);
  const simd::F8 below = at.Twice(1, 0);
  const simd::F8 corners = at.Twice(1, 1) - at.Twice(1, -1) - at.Twice(-1, 1) + at.Twice(-1, -1);
  const simd::F8 difference = at.Now(0, 0) - at.Before(0, 0);
  // d grad with the sign of the equation, then half the Hessian, xy counting twice.
  const simd::F8 row[kUnknowns] = {-0.25F * (right - left), -0.25F * (below - above),
                                   0.25F * (left - 2 * middle + right), 0.125F * corners,
                                   0.25F * (above - 2 * middle + below)};
  int k = 0;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = i; j < kUnknowns; ++j) sums[k++] += row[i] * row[j];
  }
  for (int i = 0; i < kUnknowns; ++i) sums[k++] += row[i] * difference;
  sums[k] += difference * difference;
}

POSEFUSION_KERNEL void SumProducts(const Patch& patch, float gain, double* result) {
  simd::F8 sums[kSums] = {};
  for (int v = 0; v < patch.rows; ++v) {
    const auto row = static_cast<std::size_t>(v);
    Neighbourhood at{patch.before + row * patch.before_step, patch.now + row * patch.now_step,
                     static_cast<std::ptrdiff_t>(patch.before_step),
                     static_cast<std::ptrdiff_t>(patch.now_step), simd::Broadcast(gain)};
    for (int u = 0; u < patch.columns; u += simd::kLanes) {
      AddPixels(at, sums);
      at.before += simd::kLanes;
      at.now += simd::kLanes;
    }
  }
  for (int k = 0; k < kSums; ++k) result[k] = simd::Sum(sums[k]);
}

BlurEquations Unpack(const std::array<double, kSums>& sums, int count) {
  BlurEquations equations;
  equations.count = count;
  std::size_t k = 0;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = i; j < kUnknowns; ++j) {
      equations.normal(i, j) = equations.normal(j, i) = sums[k++];
    }
  }
  for (int i = 0; i < kUnknowns; ++i) equations.right[i] = sums[k++];
  equations.square = sums[k];
  return equations;
}

}  // namespace

std::optional<BlurEquations> BuildBlurEquations(const cv::Mat& before, const cv::Mat& now,
                                                const cv::Rect& area, cv::Point shift) {
  cv::Rect here = area;
  here.width -= here.width % simd::kLanes;
  if (here.empty()) return std::nullopt;
  const cv::Rect there = here - shift;
  const double mean_before = cv::mean(before(there))[0];
  const double mean_now = cv::mean(now(here))[0];
  if (mean_before < kDark || mean_now < kDark) return std::nullopt;
  const Patch patch{before.ptr<float>(there.y) + there.x,
                    now.ptr<float>(here.y) + here.x,
                    before.step1(),
                    now.step1(),
                    here.width,
                    here.height};
  std::array<double, kSums> sums{};
  SumProducts(patch, static_cast<float>(mean_now / mean_before), sums.data());
  return Unpack(sums, here.area());
}

}  // namespace posefusion
