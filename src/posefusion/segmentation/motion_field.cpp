#include "posefusion/segmentation/motion_field.h"

#include <opencv2/imgproc.hpp>

namespace posefusion {

MotionField::MotionField()
    : flow_(cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST)) {
  flow_->setFinestScale(0);  // the images are small already, and arms are thin
  // Propagation goes through stripes of the image whose number depends on the number of threads.
  flow_->setUseSpatialPropagation(false);
}

void MotionField::Estimate(const cv::Mat& now, const cv::Mat& before, cv::Mat& motion) {
  flow_->calc(now, before, motion);
}

void ReduceToCells(const cv::Mat& rgb, cv::Size size, cv::Mat& grey) {
  cv::Mat small;
  cv::resize(rgb, small, size, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_RGB2GRAY);
}

}  // namespace posefusion
