#include "posefusion/segmentation/mask_overlay.h"

#include <opencv2/imgproc.hpp>

namespace posefusion {
namespace {

constexpr double kTint = 0.5;

cv::Mat SurfacesMask(const PersonCutter& cutter, const cv::Size& size) {
  const Grid<std::uint8_t>& cells = cutter.background_cells();
  const int size_px = cutter.cells().size_px();
  cv::Mat mask(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      mask.at<std::uint8_t>(v, u) = cells.at(u / size_px, v / size_px);
    }
  }
  return mask;
}

}  // namespace

void TintMask(const cv::Mat& rgb, const cv::Mat& mask, const cv::Scalar& colour, cv::Mat& picture) {
  cv::Mat tinted;
  cv::addWeighted(rgb, 1 - kTint, cv::Mat(rgb.size(), CV_8UC3, colour), kTint, 0, tinted);
  tinted.copyTo(picture, mask);
}

cv::Mat DrawCut(const cv::Mat& rgb, const cv::Mat& mask, const PersonCutter& cutter) {
  cv::Mat picture = rgb.clone();
  TintMask(rgb, SurfacesMask(cutter, rgb.size()), {0, 0, 255}, picture);
  TintMask(rgb, mask, {255, 0, 0}, picture);
  for (const PersonSeeds& person : cutter.people()) {
    for (std::size_t i = 0; i < person.seeds.size(); ++i) {
      const bool is_joint = static_cast<int>(i) < person.num_joints;
      cv::circle(picture, person.seeds[i].pixel, is_joint ? 3 : 1,
                 is_joint ? cv::Scalar(255, 255, 0) : cv::Scalar(0, 255, 0), cv::FILLED);
    }
  }
  return picture;
}

}  // namespace posefusion
