#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace posefusion {

/// A picture like that of a room: filled rectangles of random grey levels and sizes, through a
/// lens. `contrast` is the largest distance of a grey level from the middle one.
inline cv::Mat RoomImage(int seed, int contrast = 100) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(128));
  cv::RNG random(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < 400; ++i) {
    const int largest = i < 40 ? 240 : 24;  // furniture first, then what lies on it
    const cv::Rect box(random.uniform(-40, 640), random.uniform(-40, 480),
                       random.uniform(3, largest), random.uniform(3, largest));
    cv::rectangle(image, box, cv::Scalar::all(128 + random.uniform(-contrast, contrast)), -1);
  }
  constexpr double kLensSigmaPx = 0.6;  // no lens gives an edge from one pixel to the next
  cv::GaussianBlur(image, image, {0, 0}, kLensSigmaPx);
  return image;
}

/// White with a little shading towards the edges.
inline cv::Mat WallImage() {
  cv::Mat image(480, 640, CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double radius = std::hypot((u - 320) / 320.0, (v - 240) / 240.0);
      image.at<cv::Vec3b>(v, u) = cv::Vec3b::all(cv::saturate_cast<uchar>(220 - 20 * radius));
    }
  }
  return image;
}

/// A smooth change from dark to bright.
inline cv::Mat GradientImage() {
  cv::Mat image(480, 640, CV_8UC3);
  for (int u = 0; u < image.cols; ++u) image.col(u).setTo(cv::Scalar::all(40 + u * 160 / 640));
  return image;
}

/// What a camera sees that moves by `length_px` in the direction `angle_rad` during the exposure.
inline cv::Mat MotionBlurred(const cv::Mat& image, int length_px, double angle_rad) {
  const int size = length_px + 3 - length_px % 2;
  cv::Mat kernel = cv::Mat::zeros(size, size, CV_8UC1);
  const cv::Point2d half(0.5 * (length_px - 1) * std::cos(angle_rad),
                         0.5 * (length_px - 1) * std::sin(angle_rad));
  const cv::Point2d centre(0.5 * (size - 1), 0.5 * (size - 1));
  constexpr int kFractionBits = 8;
  const cv::Point begin((centre - half) * (1 << kFractionBits));
  const cv::Point end((centre + half) * (1 << kFractionBits));
  cv::line(kernel, begin, end, cv::Scalar(255), 1, cv::LINE_AA, kFractionBits);
  cv::Mat weights;
  kernel.convertTo(weights, CV_32F, 1 / cv::sum(kernel)[0]);
  cv::Mat blurred;
  cv::filter2D(image, blurred, -1, weights, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return blurred;
}

/// The image with independent normal noise in all channels alike, as a grey sensor has it.
inline cv::Mat WithNoise(const cv::Mat& image, double sigma, int seed) {
  cv::Mat noise(image.size(), CV_16SC1);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::Mat sum;
  image.convertTo(sum, CV_16SC3);
  cv::Mat channels;
  cv::merge(std::vector<cv::Mat>{noise, noise, noise}, channels);
  sum += channels;
  cv::Mat result;
  sum.convertTo(result, CV_8UC3);
  return result;
}

}  // namespace posefusion
