#include "posefusion/image/blur_filter.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "posefusion/config/config.h"
#include "posefusion/image/sharpness.h"

namespace posefusion {
namespace {

BlurFilterConfig Checked(const BlurFilterConfig& config) {
  CheckRanges("blur_filter", config);
  return config;
}

cv::Mat GreyImage(const cv::Mat& rgb) {
  if (rgb.empty() || rgb.type() != CV_8UC3) {
    throw std::invalid_argument("blur filter: image is not 8UC3");
  }
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

}  // namespace

const char* ToString(BlurReason reason) {
  switch (reason) {
    case BlurReason::kDisabled:
      return "disabled";
    case BlurReason::kSharp:
      return "sharp";
    case BlurReason::kDetailed:
      return "detailed";
    case BlurReason::kNoTexture:
      return "no_texture";
    case BlurReason::kDropLimit:
      return "drop_limit";
    case BlurReason::kBlurred:
      return "blurred";
  }
  return "";
}

BlurFilter::BlurFilter(const BlurFilterConfig& config)
    : config_(Checked(config)), length_(config_.exposure_s) {}

BlurDecision BlurFilter::Judge(const cv::Mat& rgb, StampNs stamp_ns) {
  ++counts_.seen;
  if (!config_.enabled) return {true, 0, 0, BlurReason::kDisabled};
  const cv::Mat grey = GreyImage(rgb);
  BlurDecision decision =
      config_.mode == BlurMode::kAbsolute ? CompareScore(grey) : CompareLength(grey, stamp_ns);
  if (!decision.keep && consecutive_drops_ >= config_.max_consecutive_drops) {
    decision.keep = true;
    decision.reason = BlurReason::kDropLimit;
  }
  consecutive_drops_ = decision.keep ? 0 : consecutive_drops_ + 1;
  if (!decision.keep) ++counts_.dropped;
  return decision;
}

BlurDecision BlurFilter::CompareScore(const cv::Mat& grey) const {
  const double score = VarianceOfLaplacian(grey);
  if (CoarseContrast(grey) < config_.min_contrast) {
    return {true, score, config_.threshold, BlurReason::kNoTexture};
  }
  const bool keep = score >= config_.threshold;
  return {keep, score, config_.threshold, keep ? BlurReason::kSharp : BlurReason::kBlurred};
}

BlurDecision BlurFilter::CompareLength(const cv::Mat& grey, StampNs stamp_ns) {
  const BlurEstimate blur = length_.Next(grey, stamp_ns);
  const double limit_px = config_.max_length_px;
  if (blur.contrast < config_.min_contrast) {
    length_.Forget();
    return {true, blur.length_px, limit_px, BlurReason::kNoTexture};
  }
  if (blur.length_px <= limit_px) return {true, blur.length_px, limit_px, BlurReason::kSharp};
  if (blur.detail >= config_.enough_detail && !blur.is_sudden) {
    return {true, blur.length_px, limit_px, BlurReason::kDetailed};
  }
  return {false, blur.length_px, limit_px, BlurReason::kBlurred};
}

}  // namespace posefusion
