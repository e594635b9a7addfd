#include "posefusion/image/image_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace posefusion {
namespace {

constexpr int kCoarseWidth = 160;
constexpr int kTile = 64;  ///< pixels of the coarse image
constexpr int kTileColumns = 4;
constexpr int kTileRows = 3;
constexpr int kBlockColumns = 8;
constexpr int kBlockRows = 6;
constexpr std::size_t kMinBlocks = 4;
constexpr double kLengthQuantile = 0.45;  ///< below the median: people move more than the room
constexpr double kMinDeviation = 1.5;     ///< grey levels: four times what noise leaves
constexpr double kMinResponse = 0.1;      ///< share of the correlation that its peak holds
constexpr int kPeakRadius = 2;

cv::Mat Coarse(const cv::Mat& grey) {
  cv::Mat coarse;
  const int width = std::min(kCoarseWidth, grey.cols);
  cv::resize(grey, coarse, {width, grey.rows * width / grey.cols}, 0, 0, cv::INTER_AREA);
  coarse.convertTo(coarse, CV_32F);
  return coarse;
}

/// The product of the spectra with all amplitudes made 1, so that only phases count.
cv::Mat CrossPowerSpectrum(const cv::Mat& from, const cv::Mat& to) {
  cv::Mat product;
  cv::mulSpectrums(to, from, product, 0, /*conjB=*/true);
  for (int v = 0; v < product.rows; ++v) {
    auto* row = product.ptr<cv::Vec2f>(v);
    for (int u = 0; u < product.cols; ++u) {
      row[u] *= 1 / (std::sqrt(row[u][0] * row[u][0] + row[u][1] * row[u][1]) + 1e-6F);
    }
  }
  return product;
}

/// Index of a cyclic correlation as a shift of either sign.
double Signed(double index) { return index > kTile / 2 ? index - kTile : index; }

/// The peak's centroid, and what share of the whole it holds.
std::optional<cv::Point2d> FindPeak(const cv::Mat& correlation) {
  cv::Point peak;
  cv::minMaxLoc(correlation, nullptr, nullptr, nullptr, &peak);
  double sum = 0;
  cv::Point2d weighted(0, 0);
  for (int dv = -kPeakRadius; dv <= kPeakRadius; ++dv) {
    const auto* row = correlation.ptr<float>((peak.y + dv + kTile) % kTile);
    for (int du = -kPeakRadius; du <= kPeakRadius; ++du) {
      const double value = static_cast<double>(row[(peak.x + du + kTile) % kTile]);
      sum += value;
      weighted += value * cv::Point2d(du, dv);
    }
  }
  if (sum < kMinResponse) return std::nullopt;
  return cv::Point2d(Signed(peak.x), Signed(peak.y)) + weighted / sum;
}

double QuantileOf(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Mean of each block.
cv::Mat BlockMeans(const cv::Mat& image) {
  cv::Mat means;
  cv::resize(image, means, {kBlockColumns, kBlockRows}, 0, 0, cv::INTER_AREA);
  return means;
}

/// Which blocks have something to show (CV_8UC1).
cv::Mat TexturedBlocks(const cv::Mat& coarse) {
  const cv::Mat means = BlockMeans(coarse);
  return BlockMeans(coarse.mul(coarse)) - means.mul(means) >= kMinDeviation * kMinDeviation;
}

/// For each block the number of the shift that explains it best (CV_8UC1).
cv::Mat BestShifts(const cv::Mat& before, const cv::Mat& now,
                   const std::vector<cv::Point2d>& shifts) {
  cv::Mat best(kBlockRows, kBlockColumns, CV_8UC1, cv::Scalar(0));
  cv::Mat least;
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    const cv::Matx23d move(1, 0, shifts[i].x, 0, 1, shifts[i].y);
    cv::Mat moved;
    cv::warpAffine(before, moved, move, before.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    const cv::Mat difference = BlockMeans(cv::abs(now - moved));
    if (least.empty()) {
      least = difference;
      continue;
    }
    best.setTo(cv::Scalar(static_cast<double>(i)), difference < least);
    least = cv::min(least, difference);
  }
  return best;
}

/// The median over the blocks, each with the shift that explains it best.
std::optional<ImageShift> MedianShift(const cv::Mat& before, const cv::Mat& now,
                                      const std::vector<cv::Point2d>& shifts, double scale) {
  const cv::Mat best = BestShifts(before, now, shifts);
  const cv::Mat textured = TexturedBlocks(now);
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> length;
  for (int row = 0; row < kBlockRows; ++row) {
    for (int column = 0; column < kBlockColumns; ++column) {
      if (textured.at<std::uint8_t>(row, column) == 0) continue;
      const cv::Point2d& shift = shifts[best.at<std::uint8_t>(row, column)];
      x.push_back(scale * shift.x);
      y.push_back(scale * shift.y);
      length.push_back(scale * std::hypot(shift.x, shift.y));
    }
  }
  if (length.size() < kMinBlocks) return std::nullopt;
  return ImageShift{{QuantileOf(x, 0.5), QuantileOf(y, 0.5)}, QuantileOf(length, kLengthQuantile)};
}

}  // namespace

std::vector<ImageMotion::Tile> ImageMotion::Analyse(const cv::Mat& coarse) const {
  std::vector<Tile> tiles;
  for (int row = 0; row < kTileRows; ++row) {
    for (int column = 0; column < kTileColumns; ++column) {
      const cv::Rect area((coarse.cols - kTile) * column / (kTileColumns - 1),
                          (coarse.rows - kTile) * row / (kTileRows - 1), kTile, kTile);
      cv::Scalar mean;
      cv::Scalar deviation;
      cv::meanStdDev(coarse(area), mean, deviation);
      Tile tile;
      tile.has_texture = deviation[0] >= kMinDeviation;
      cv::dft(coarse(area).mul(window_), tile.spectrum, cv::DFT_COMPLEX_OUTPUT);
      tiles.push_back(tile);
    }
  }
  return tiles;
}

std::vector<cv::Point2d> ImageMotion::TileShifts(const std::vector<Tile>& tiles) const {
  std::vector<cv::Point2d> shifts;
  for (std::size_t i = 0; i < last_tiles_.size(); ++i) {
    if (!tiles[i].has_texture) continue;
    cv::Mat correlation;
    cv::dft(CrossPowerSpectrum(last_tiles_[i].spectrum, tiles[i].spectrum), correlation,
            cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
    if (const auto shift = FindPeak(correlation)) shifts.push_back(*shift);
  }
  return shifts;
}

std::optional<ImageShift> ImageMotion::Next(const cv::Mat& grey) {
  const cv::Mat coarse = Coarse(grey);
  if (grey.size() != size_) last_tiles_.clear();
  size_ = grey.size();
  if (coarse.cols < kTile || coarse.rows < kTile) return std::nullopt;
  if (window_.empty()) cv::createHanningWindow(window_, {kTile, kTile}, CV_32F);
  std::vector<Tile> tiles = Analyse(coarse);
  std::vector<cv::Point2d> shifts = TileShifts(tiles);
  last_tiles_ = std::move(tiles);
  const cv::Mat before = std::exchange(last_, coarse);
  if (shifts.empty()) return std::nullopt;
  shifts.emplace_back(0, 0);
  return MedianShift(before, coarse, shifts, static_cast<double>(grey.cols) / coarse.cols);
}

}  // namespace posefusion
