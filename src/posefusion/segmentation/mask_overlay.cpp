#include "posefusion/segmentation/mask_overlay.h"

#include <opencv2/imgproc.hpp>

namespace posefusion {

cv::Mat DrawMask(const cv::Mat& rgb, const cv::Mat& mask, const std::vector<PersonSeeds>& people) {
  constexpr double kTint = 0.5;
  cv::Mat tinted;
  cv::addWeighted(rgb, 1 - kTint, cv::Mat(rgb.size(), CV_8UC3, cv::Scalar(255, 0, 0)), kTint, 0,
                  tinted);
  cv::Mat picture = rgb.clone();
  tinted.copyTo(picture, mask);
  for (const PersonSeeds& person : people) {
    for (std::size_t i = 0; i < person.seeds.size(); ++i) {
      const bool is_joint = static_cast<int>(i) < person.num_joints;
      cv::circle(picture, person.seeds[i].pixel, is_joint ? 3 : 1,
                 is_joint ? cv::Scalar(255, 255, 0) : cv::Scalar(0, 255, 0), cv::FILLED);
    }
  }
  return picture;
}

}  // namespace posefusion
