#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/camera_model.h"
#include "posefusion/image/depth_filter.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/normals.h"
#include "posefusion/image/people_in_frame.h"
#include "posefusion/image/rgbd_frame.h"

namespace posefusion {

/// One resolution of a frame. Pixel grids of equal size.
struct PyramidLevel {
  CameraModel camera;
  Grid<float> intensity;  ///< grey 0..255; below 0 = masked or not seen
  Grid<float> depth_m;    ///< smoothed, 0 = none or masked
  NormalMap normals;      ///< of depth_m
};

/// What tracking and fusion need of a rectified frame, made once per frame.
struct FramePyramid {
  StampNs stamp_ns = 0;  ///< of the colour image
  StampNs depth_stamp_ns = 0;
  cv::Mat rgb;                       ///< as in the frame
  Grid<float> raw_depth_m;           ///< as in the frame within the cut-off, 0 = none or masked
  Grid<float> person_depth_m;        ///< well inside the mask, 0 elsewhere; empty without a mask
  std::vector<PyramidLevel> levels;  ///< 0 = full resolution
};

struct PyramidConfig {
  int num_levels = 5;        ///< resolutions, each half of the one before
  double min_depth_m = 0.3;  ///< nearer depth is ignored
  double max_depth_m = 5.0;  ///< depth cut-off: farther depth is ignored
  bool mask_rgb = true;      ///< people are kept out of the intensities too, not only of the depth
  int person_rim_px = 4;  ///< masked pixels this close to the mask's border may show something else
  DepthFilterConfig depth_filter;
  NormalConfig normals;
};

template <class V>
void Describe(V& v, PyramidConfig& c) {
  v.Field("num_levels", c.num_levels, 1, 6);
  v.Field("min_depth_m", c.min_depth_m, 0.0, 10.0);
  v.Field("max_depth_m", c.max_depth_m, 0.1, 100.0);
  v.Field("mask_rgb", c.mask_rgb);
  v.Field("person_rim_px", c.person_rim_px, 0, 100);
  v.Group("depth_filter", c.depth_filter);
  v.Group("normals", c.normals);
}

/// Builds pyramids, reusing the memory of the one given back.
class PyramidBuilder {
 public:
  PyramidBuilder(const PyramidConfig& config, const DepthNoiseConfig& noise);

  /// Fills `pyramid` from a frame without distortion. People lose their depth, and their intensity
  /// with mask_rgb, at every level that touches them.
  void Build(const RgbdFrame& frame, const PeopleInFrame& people, const ParallelRunner& parallel,
             FramePyramid& pyramid);

 private:
  void TakeOutPeople(const RgbdFrame& frame, const PeopleInFrame& people,
                     const ParallelRunner& parallel, FramePyramid& pyramid);

  PyramidConfig config_;
  DepthNoiseConfig noise_;
  DepthFilter depth_filter_;
  cv::Mat inner_mask_;  ///< the mask without its rim
};

}  // namespace posefusion
