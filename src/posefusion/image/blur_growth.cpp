#include "posefusion/image/blur_growth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "posefusion/image/blur_equations.h"

namespace posefusion {
namespace {

constexpr int kColumns = 8;
constexpr int kRows = 6;
constexpr int kSamples = 5;        ///< of the motion per tile and direction
constexpr double kSmoothPx = 1.2;  ///< makes an edge wider than the blur that matters
constexpr double kScale = 2;       ///< of the full image against the smoothed one
/// A blur of length l along x is as good as a diffusion of variance l^2 / 12.
constexpr double kLengthSquarePerVariance = 12 * kScale * kScale;
constexpr double kMaxRest = 4;  ///< pixels of the smoothed image; more is no match
constexpr double kNoise = 0.1;  ///< square of what noise of 2 grey levels leaves of a difference
constexpr double kStiffness = 0.02;  ///< grey levels^2 per pixel: without texture nothing changes

/// Median motion in a tile.
cv::Point2d TileMotion(const cv::Mat& motion_px, int row, int column) {
  std::array<float, kSamples * kSamples> x{};
  std::array<float, kSamples * kSamples> y{};
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const double v = (row + (i / kSamples + 0.5) / kSamples) * motion_px.rows / kRows;
    const double u = (column + (i % kSamples + 0.5) / kSamples) * motion_px.cols / kColumns;
    const auto& motion = motion_px.at<cv::Vec2f>(static_cast<int>(v), static_cast<int>(u));
    x[static_cast<std::size_t>(i)] = motion[0];
    y[static_cast<std::size_t>(i)] = motion[1];
  }
  std::nth_element(x.begin(), x.begin() + x.size() / 2, x.end());
  std::nth_element(y.begin(), y.begin() + y.size() / 2, y.end());
  return {x[x.size() / 2], y[y.size() / 2]};
}

void Solve(BlurEquations equations, BlurTile& tile) {
  const double count = equations.count;
  equations.normal.diagonal().array() += kStiffness * count;
  const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> factors(equations.normal);
  const Eigen::Matrix<double, 5, 1> x = factors.solve(equations.right);
  if (std::hypot(x[0], x[1]) > kMaxRest) return;
  const Eigen::Matrix<double, 5, 5> inverse =
      factors.solve(Eigen::Matrix<double, 5, 5>::Identity());
  const double noise = std::max(0.0, (equations.square - x.dot(equations.right)) / count) + kNoise;
  constexpr double kUnit = kLengthSquarePerVariance;
  tile.matches = true;
  tile.growth_xx_px2 = kUnit * x[2];
  tile.growth_yy_px2 = kUnit * x[4];
  tile.weight_xx = 1 / (kUnit * kUnit * noise * inverse(2, 2));
  tile.weight_yy = 1 / (kUnit * kUnit * noise * inverse(4, 4));
}

/// Compares the tile of `now` with what of `before` went there.
BlurTile MeasureTile(const cv::Mat& before, const cv::Mat& now, const cv::Mat& motion_px, int row,
                     int column) {
  BlurTile tile;
  tile.moved_px = TileMotion(motion_px, row, column);
  const cv::Point shift(cvRound(tile.moved_px.x / kScale), cvRound(tile.moved_px.y / kScale));
  const cv::Rect inner(1, 1, now.cols - 2, now.rows - 2);  // derivatives need a margin
  const cv::Rect whole(column * now.cols / kColumns, row * now.rows / kRows, now.cols / kColumns,
                       now.rows / kRows);
  const cv::Rect area = whole & inner & (inner + shift);
  if (area.area() < whole.area() / 4) return tile;
  const auto equations = BuildBlurEquations(before, now, area, shift);
  if (equations) Solve(*equations, tile);
  return tile;
}

}  // namespace

void SmoothForBlurGrowth(const cv::Mat& grey, cv::Mat& smooth) {
  cv::Mat half;
  cv::resize(grey, half, {grey.cols / 2, grey.rows / 2}, 0, 0, cv::INTER_AREA);
  half.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, kSmoothPx);
}

std::vector<BlurTile> MeasureBlurGrowth(const cv::Mat& before, const cv::Mat& now,
                                        const cv::Mat& motion_px) {
  std::vector<BlurTile> tiles;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      tiles.push_back(MeasureTile(before, now, motion_px, row, column));
    }
  }
  return tiles;
}

}  // namespace posefusion
