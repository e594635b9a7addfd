#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace posefusion {

/// Finds how parts of an image may have moved since the image before: the phase correlation
/// (Kuglin, Hines 1975) of twelve overlapping tiles of 64x64 pixels. Reaches some 30 pixels. The
/// same images give the same result. Not thread-safe.
class ShiftProposals {
 public:
  /// Takes the next image (CV_32FC1, at least 64 rows and columns, all of one size) and gives
  /// where the content of a tile went, for each in which it can be told; nothing for the first.
  const std::vector<cv::Point2f>& Next(const cv::Mat& image);

  /// The next image does not follow on another.
  void Forget();

  static constexpr int kTile = 64;  ///< pixels

 private:
  struct Tile {
    cv::Mat spectrum;
    bool has_texture = false;
  };

  void Analyse(const cv::Mat& image, std::vector<Tile>& tiles);

  cv::Mat window_;
  cv::Mat windowed_;
  cv::Mat correlation_;
  std::vector<Tile> before_;
  std::vector<Tile> now_;
  std::vector<cv::Point2f> shifts_px_;
};

}  // namespace posefusion
