#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace posefusion {

/// How the content of an image has moved since the image before.
struct ImageShift {
  cv::Point2d shift_px;  ///< median over the image of where the content went
  double length_px = 0;  ///< about the median of how far; more than |shift_px| when it turns
};

/// Follows the motion of the image at a width of 160 pixels. Phase correlation (Kuglin, Hines 1975)
/// of twelve overlapping tiles proposes shifts; each of 8x6 blocks takes the one that explains it
/// best, and the median over the blocks that have something to show is the result. So a person who
/// passes does not decide before covering half of it. Reaches about a fifth of the image's width
/// per frame. The same images give the same result. Not thread-safe.
class ImageMotion {
 public:
  /// Takes the next image (CV_8UC1). Nothing for the first one, after another size, for images of
  /// less than 64 rows or columns, and where hardly anything has texture.
  std::optional<ImageShift> Next(const cv::Mat& grey);

 private:
  struct Tile {
    cv::Mat spectrum;
    bool has_texture = false;
  };

  std::vector<Tile> Analyse(const cv::Mat& coarse) const;
  std::vector<cv::Point2d> TileShifts(const std::vector<Tile>& tiles) const;

  cv::Mat window_;
  cv::Size size_;  ///< of the last image
  cv::Mat last_;   ///< reduced, CV_32FC1
  std::vector<Tile> last_tiles_;
};

}  // namespace posefusion
