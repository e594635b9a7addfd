#include "posefusion/image/shift_proposals.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

namespace posefusion {
namespace {

constexpr int kTile = ShiftProposals::kTile;
constexpr int kTileColumns = 4;
constexpr int kTileRows = 3;
constexpr double kMinDeviation = 1.5;  ///< grey levels: four times what noise leaves
constexpr double kMinResponse = 0.1;   ///< share of the correlation that its peak holds
constexpr int kPeakRadius = 2;

/// The product of the spectra with all amplitudes made 1, so that only phases count.
void CrossPowerSpectrum(const cv::Mat& from, const cv::Mat& to, cv::Mat& product) {
  cv::mulSpectrums(to, from, product, 0, /*conjB=*/true);
  for (int v = 0; v < product.rows; ++v) {
    auto* row = product.ptr<cv::Vec2f>(v);
    for (int u = 0; u < product.cols; ++u) {
      row[u] *= 1 / (std::sqrt(row[u][0] * row[u][0] + row[u][1] * row[u][1]) + 1e-6F);
    }
  }
}

/// Index of a cyclic correlation as a shift of either sign.
double Signed(double index) { return index > kTile / 2 ? index - kTile : index; }

/// The peak's centroid, and what share of the whole it holds.
std::optional<cv::Point2f> FindPeak(const cv::Mat& correlation) {
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
  return cv::Point2f(cv::Point2d(Signed(peak.x), Signed(peak.y)) + weighted / sum);
}

}  // namespace

void ShiftProposals::Analyse(const cv::Mat& image, std::vector<Tile>& tiles) {
  tiles.resize(kTileRows * kTileColumns);
  for (int row = 0; row < kTileRows; ++row) {
    for (int column = 0; column < kTileColumns; ++column) {
      const cv::Rect area((image.cols - kTile) * column / (kTileColumns - 1),
                          (image.rows - kTile) * row / (kTileRows - 1), kTile, kTile);
      cv::Scalar mean;
      cv::Scalar deviation;
      cv::meanStdDev(image(area), mean, deviation);
      Tile& tile = tiles[static_cast<std::size_t>(row * kTileColumns + column)];
      tile.has_texture = deviation[0] >= kMinDeviation;
      cv::multiply(image(area), window_, windowed_);
      cv::dft(windowed_, tile.spectrum, cv::DFT_COMPLEX_OUTPUT);
    }
  }
}

const std::vector<cv::Point2f>& ShiftProposals::Next(const cv::Mat& image) {
  if (window_.empty()) cv::createHanningWindow(window_, {kTile, kTile}, CV_32F);
  std::swap(before_, now_);
  Analyse(image, now_);
  shifts_px_.clear();
  cv::Mat product;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    if (!now_[i].has_texture) continue;
    CrossPowerSpectrum(before_[i].spectrum, now_[i].spectrum, product);
    cv::dft(product, correlation_, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
    if (const auto shift = FindPeak(correlation_)) shifts_px_.push_back(*shift);
  }
  return shifts_px_;
}

void ShiftProposals::Forget() {
  before_.clear();
  now_.clear();
}

}  // namespace posefusion
