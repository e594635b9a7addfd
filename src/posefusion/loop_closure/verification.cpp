#include "posefusion/loop_closure/verification.h"

#include <cmath>
#include <vector>

#include "posefusion/common/stage_clock.h"

namespace posefusion {
namespace {

/// Depths agree within the model's own error and so many sigmas of the sensor.
constexpr double kModelErrorM = 0.02;
constexpr double kDepthSigmas = 4;
/// Intensities agree within this, grey levels.
constexpr double kIntensityTolerance = 20;

double Share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// Share of the differences close to their median.
double ShareNearMedian(const std::vector<double>& differences) {
  const double median = Quantile(differences, 0.5);
  std::size_t near = 0;
  for (const double d : differences) near += std::abs(d - median) <= kIntensityTolerance ? 1 : 0;
  return Share(near, differences.size());
}

/// Sums over pairs of intensities.
struct Correlation {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void Add(double x, double y) {
    n += 1;
    a += x;
    b += y;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  double Coefficient() const {
    const double variances = (n * aa - a * a) * (n * bb - b * b);
    return variances > 0 ? (n * ab - a * b) / std::sqrt(variances) : 0;
  }
};

}  // namespace

Agreement CompareWithView(const PyramidLevel& frame, const ModelView& view,
                          const Eigen::Isometry3d& T_view_camera, const DepthNoiseConfig& noise) {
  std::size_t measured = 0;
  std::size_t overlapping = 0;
  std::size_t agreeing = 0;
  std::vector<double> differences;
  Correlation correlation;
  for (int y = 0; y < frame.camera.height; ++y) {
    for (int x = 0; x < frame.camera.width; ++x) {
      const double depth_m = frame.depth_m.at(x, y);
      if (depth_m <= 0) continue;
      ++measured;
      const Eigen::Vector3d p_view = T_view_camera * frame.camera.Unproject(x, y, depth_m);
      if (p_view.z() <= 0) continue;
      const Eigen::Vector2d pixel = view.camera.Project(p_view);
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (u < 0 || v < 0 || u >= view.camera.width || v >= view.camera.height) continue;
      const double model_m = view.depth_m.at(u, v);
      if (model_m <= 0) continue;
      ++overlapping;
      const double tolerance_m =
          kModelErrorM + kDepthSigmas * DepthSigma(noise, static_cast<float>(depth_m));
      if (std::abs(p_view.z() - model_m) > tolerance_m) continue;
      ++agreeing;
      const double intensity = frame.intensity.at(x, y);
      const double model_intensity = view.intensity.at(u, v);
      if (intensity >= 0 && model_intensity >= 0) {
        differences.push_back(intensity - model_intensity);
        correlation.Add(intensity, model_intensity);
      }
    }
  }
  Agreement agreement;
  agreement.overlap = Share(overlapping, measured);
  agreement.depth = Share(agreeing, overlapping);
  agreement.correlation = correlation.Coefficient();
  agreement.intensity = ShareNearMedian(differences);
  return agreement;
}

}  // namespace posefusion
