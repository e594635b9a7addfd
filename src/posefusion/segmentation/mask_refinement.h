#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/segmentation/cell_grid.h"

namespace posefusion {

struct MaskRefinementConfig {
  int grow_px = 2;             ///< the mask grows by this to take the rim of mixed pixels
  double pixel_cost_m = 0.02;  ///< a cell one cell away counts as much as this depth difference
  int fill_px = 12;            ///< pixels without depth this close to the person are person too
};

template <class V>
void Describe(V& v, MaskRefinementConfig& c) {
  v.Field("grow_px", c.grow_px, 0, 20);
  v.Field("pixel_cost_m", c.pixel_cost_m, 0.0, 1.0);
  v.Field("fill_px", c.fill_px, 0, 100);
}

/// Brings a cut of cells to full resolution along depth edges. Keeps its memory. Not thread-safe.
class MaskRefinement {
 public:
  explicit MaskRefinement(const MaskRefinementConfig& config);

  /// Adds the people of `cell_mask` (CV_8UC1, size of `cells`, 255 = person) to `mask` (CV_8UC1 of
  /// the size of `depth_m`). A pixel with depth goes with the cell around it that is nearest in
  /// depth and in the image; then the rim is added, and pixels without depth beside the person or
  /// enclosed by it.
  void Apply(const cv::Mat& cell_mask, const CellGrid& cells, const cv::Mat& depth_m,
             cv::Mat& mask);

 private:
  void DecidePixels(const cv::Mat& cell_mask, const CellGrid& cells, const cv::Rect& cell_box,
                    const cv::Mat& depth_m);
  void AddRim(const cv::Rect& box, const cv::Mat& depth_m, cv::Mat& mask);

  const MaskRefinementConfig config_;
  cv::Mat fine_;  ///< the cut at full resolution; valid in the box of the people only
  cv::Mat grown_;
  cv::Mat without_depth_;
};

}  // namespace posefusion
