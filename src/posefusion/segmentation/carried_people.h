#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "posefusion/image/grid.h"
#include "posefusion/segmentation/cell_grid.h"

namespace posefusion {

/// What a cell shows.
using CellPerson = std::uint8_t;
constexpr CellPerson kNobody = 0;  ///< background
constexpr CellPerson kMaxPersonNumber = 254;
constexpr CellPerson kUnknownCell = 255;  ///< came into view or could not be followed

inline bool IsPerson(CellPerson person) { return person != kNobody && person != kUnknownCell; }

/// Who is where in the cells of a frame.
struct CellPeople {
  Grid<CellPerson> person;  ///< number of a tracked person, or one of the constants above
  /// -1 (surely background) to 1 (surely that person): what keypoints said of the cell, smoothed.
  Grid<float> evidence;
  /// Where in the cell this is known of, cells from its centre: motion of less than a cell adds up.
  Grid<cv::Vec2f> place;

  /// Nothing is known of any cell.
  void Forget(cv::Size size) {
    person.Resize(size.width, size.height);
    evidence.Resize(size.width, size.height);
    place.Resize(size.width, size.height);
    person.Fill(kUnknownCell);
    evidence.Fill(0);
    place.Fill(cv::Vec2f(0, 0));
  }
};

struct CarryConfig {
  double depth_step_m = 0.06;    ///< the same surface changes depth by less than this ...
  double depth_sigmas = 3.0;     ///< ... and so many depth noise sigmas ...
  double depth_speed_m_s = 1.5;  ///< ... and this speed times the time between the frames
  /// For cells that could not be followed r of equation 3 and the cost of calling them background:
  /// small, so that their neighbours on the same surface decide.
  double radius_m = 4.0;
  double source_weight = 0.1;
  double colour_weight = 0.1;  ///< of one nat that colours of people tell of them
  double layer_gap_m = 0.10;   ///< neighbours this far apart in depth are of different surfaces
};

template <class V>
void Describe(V& v, CarryConfig& c) {
  v.Field("depth_step_m", c.depth_step_m, 0.0, 1.0);
  v.Field("depth_sigmas", c.depth_sigmas, 0.0, 20.0);
  v.Field("depth_speed_m_s", c.depth_speed_m_s, 0.0, 20.0);
  v.Field("radius_m", c.radius_m, 0.02, 10.0);
  v.Field("source_weight", c.source_weight, 0.0, 100.0);
  v.Field("colour_weight", c.colour_weight, 0.0, 100.0);
  v.Field("layer_gap_m", c.layer_gap_m, 0.01, 1.0);
}

/// Follows the cells of `before` into `now` along `motion` (MotionField::Estimate; CV_32FC2 of the
/// cells' size). A cell whose depth does not fit where it came from, or that came from the border
/// between person and background, is unknown. `interval_s` is the time between the two frames.
void CarryPeople(const CellPeople& before, const CellGrid& cells_before, const cv::Mat& motion,
                 const CellGrid& cells_now, double interval_s, const CarryConfig& config,
                 CellPeople& now);

}  // namespace posefusion
