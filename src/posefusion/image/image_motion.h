#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "posefusion/image/shift_proposals.h"

namespace posefusion {

/// Follows the motion of the image at a width of 160 pixels. Each of 8x6 blocks takes the one of
/// the ShiftProposals that explains it best; from there dense optical flow (dense inverse search,
/// Kroeger et al. 2016) finds the motion of every pixel. Reaches about a fifth of the image's width
/// per frame. Where nothing has texture the motion is a guess. The same images give the same
/// result. Not thread-safe.
class ImageMotion {
 public:
  ImageMotion();

  /// Takes the next image (CV_8UC1) and tells where its content went since the image before: the
  /// motion in pixels of the image (CV_32FC2, 160 columns). It has the size 0 for the first image,
  /// after another size, and where less than 64 rows or columns are left. Valid until the next
  /// call.
  const cv::Mat& Next(const cv::Mat& grey);

  const cv::Mat& moved_px() const { return motion_px_; }  ///< what Next() gave

  /// Pixels of the image per pixel of the motion.
  float scale() const { return scale_; }

  /// Mean difference [grey levels] between the surroundings of a place of the motion, 5x5 of its
  /// pixels, and where they were before if they moved by `moved_px`, pixels of the image.
  float DifferenceAround(cv::Point place, const cv::Vec2f& moved_px) const;

 private:
  /// Those that differ by whole pixels, and none.
  void CollectShifts(const std::vector<cv::Point2f>& proposals);
  cv::Point2f BestShift(const cv::Rect& block) const;
  void StartFromShifts();

  ShiftProposals proposals_;
  cv::Ptr<cv::DISOpticalFlow> flow_;
  cv::Size size_;  ///< of the last image
  float scale_ = 1;
  cv::Mat before_;
  cv::Mat now_;
  cv::Mat now_f_;          ///< the same as CV_32FC1
  cv::Mat padded_before_;  ///< with a margin as far as shifts reach
  std::vector<cv::Point2f> shifts_;
  cv::Mat motion_px_;
};

}  // namespace posefusion
