#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "posefusion/image/grid.h"
#include "posefusion/segmentation/pixel_rays.h"

namespace posefusion {

struct CellGridConfig {
  int size_px = 4;  ///< a cell is a square of so many pixels; people are cut out of cells
};

template <class V>
void Describe(V& v, CellGridConfig& c) {
  v.Field("size_px", c.size_px, 1, 16);
}

/// A depth image at reduced resolution: the vertices of the graphs that are cut. Cell (x, y) covers
/// the pixels [x * size_px, (x + 1) * size_px); cells at the right and lower border may reach
/// beyond the image. Keeps its memory between images of one size. Not thread-safe.
class CellGrid {
 public:
  explicit CellGrid(const CellGridConfig& config);

  /// Depth of each cell is the lower median of some pixels spread over it: near surfaces are
  /// preferred at edges. `depth_m` is CV_32FC1 metres of camera `camera`, 0 = none.
  void Build(const cv::Mat& depth_m, const CameraModel& camera);

  int size_px() const { return size_px_; }
  /// Edge of a cell on a surface one metre away that faces the camera, metres.
  double size_at_1m() const { return size_px_ / camera_.fx; }
  int width() const { return depth_m_.width(); }
  int height() const { return depth_m_.height(); }
  cv::Size size() const { return {width(), height()}; }

  /// The cell that shows a pixel; none outside the grid or where a coordinate is no number.
  std::optional<cv::Point> CellAt(const cv::Point2f& pixel) const {
    const float x = (pixel.x + 0.5F) / static_cast<float>(size_px_);
    const float y = (pixel.y + 0.5F) / static_cast<float>(size_px_);
    const auto w = static_cast<float>(width());
    const auto h = static_cast<float>(height());
    if (!(x >= 0 && y >= 0 && x < w && y < h)) return std::nullopt;
    return cv::Point(static_cast<int>(x), static_cast<int>(y));
  }

  /// Where a point in the camera frame with z > 0 appears, in cells; the centre of cell (x, y) is
  /// (x, y).
  Eigen::Vector2d PlaceOf(const Eigen::Vector3d& p_camera) const {
    const Eigen::Vector2d pixel = DistortedPixelOf(camera_, p_camera);
    return (pixel.array() + 0.5) / size_px_ - 0.5;
  }

  /// The cell whose centre is nearest to a place, in cells; none outside the grid.
  std::optional<cv::Point> CellNear(const Eigen::Vector2d& place) const {
    const cv::Point cell(static_cast<int>(std::lround(place.x())),
                         static_cast<int>(std::lround(place.y())));
    if (!cv::Rect({0, 0}, size()).contains(cell)) return std::nullopt;
    return cell;
  }

  /// Metres, 0 = none.
  float DepthAt(int x, int y) const { return depth_m_.at(x, y); }

  /// The cell's point in the camera frame; zero where there is no depth.
  Eigen::Vector3f PointAt(int x, int y) const {
    const float z = depth_m_.at(x, y);
    return {ray_x_.at(x, y) * z, ray_y_.at(x, y) * z, z};
  }

  /// Normal of the surface through the points so many cells to each side, which must be in the grid
  /// and have depth.
  Eigen::Vector3f NormalAt(int x, int y, int reach) const {
    const Eigen::Vector3f across = PointAt(x + reach, y) - PointAt(x - reach, y);
    const Eigen::Vector3f along = PointAt(x, y + reach) - PointAt(x, y - reach);
    return across.cross(along).normalized();
  }

 private:
  void SetCamera(const CameraModel& camera);

  int size_px_;
  CameraModel camera_;
  Grid<float> depth_m_;
  Grid<float> ray_x_;  ///< x / z of each cell's centre
  Grid<float> ray_y_;
};

}  // namespace posefusion
