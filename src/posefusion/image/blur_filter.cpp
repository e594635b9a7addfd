#include "posefusion/image/blur_filter.h"

#include <algorithm>
#include <vector>

#include "posefusion/config/config.h"

namespace posefusion {
namespace {

/// Sum of the squares of the Laplacian kernel: variance of its response to noise of variance 1.
constexpr double kNoiseGain = 20;

/// What is left of the score at least, as a share of the noise: a smaller difference of score and
/// noise is chance, and no measure for the next frame.
constexpr double kMinScorePerNoise = 0.05;

double Median(const std::deque<double>& values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

BlurFilterConfig Checked(const BlurFilterConfig& config) {
  CheckRanges("blur_filter", config);
  return config;
}

}  // namespace

const char* ToString(BlurReason reason) {
  switch (reason) {
    case BlurReason::kDisabled:
      return "disabled";
    case BlurReason::kSharp:
      return "sharp";
    case BlurReason::kLessContrast:
      return "less_contrast";
    case BlurReason::kNoTexture:
      return "no_texture";
    case BlurReason::kDropLimit:
      return "drop_limit";
    case BlurReason::kBlurred:
      return "blurred";
  }
  return "";
}

BlurFilter::BlurFilter(const BlurFilterConfig& config) : config_(Checked(config)) {}

BlurDecision BlurFilter::Judge(const cv::Mat& rgb) {
  ++counts_.seen;
  if (!config_.enabled) return {true, 0, 0, BlurReason::kDisabled};
  const ImageSharpness sharpness = MeasureSharpness(rgb);
  const double score = Score(sharpness);
  if (sharpness.contrast < config_.min_contrast) {
    consecutive_drops_ = 0;
    return {true, score, 0, BlurReason::kNoTexture};
  }
  BlurDecision decision = Compare(score, sharpness.contrast);
  if (!decision.keep && consecutive_drops_ >= config_.max_consecutive_drops) {
    decision.keep = true;
    decision.reason = BlurReason::kDropLimit;
  }
  consecutive_drops_ = decision.keep ? 0 : consecutive_drops_ + 1;
  if (decision.keep) Remember(score, sharpness.contrast);
  if (!decision.keep) ++counts_.dropped;
  return decision;
}

double BlurFilter::Score(const ImageSharpness& sharpness) const {
  const double noise_limit =
      kNoiseGain * config_.max_noise_grey_levels * config_.max_noise_grey_levels;
  const double noise = std::min(sharpness.noise_variance, noise_limit);
  return std::max(sharpness.laplacian_variance - noise, kMinScorePerNoise * noise);
}

BlurDecision BlurFilter::Compare(double score, double contrast) const {
  if (config_.mode == BlurMode::kAbsolute) {
    const bool keep = score >= config_.threshold;
    return {keep, score, config_.threshold, keep ? BlurReason::kSharp : BlurReason::kBlurred};
  }
  if (scores_.empty()) return {true, score, 0, BlurReason::kSharp};
  const double threshold = config_.relative_threshold * Median(scores_);
  if (score >= threshold) return {true, score, threshold, BlurReason::kSharp};
  const double ratio_threshold = config_.contrast_ratio_threshold * Median(contrast_ratios_);
  if (score >= ratio_threshold * contrast) {
    return {true, score, threshold, BlurReason::kLessContrast};
  }
  return {false, score, threshold, BlurReason::kBlurred};
}

void BlurFilter::Remember(double score, double contrast) {
  scores_.push_back(score);
  contrast_ratios_.push_back(score / std::max(contrast, 1e-9));
  if (scores_.size() <= static_cast<std::size_t>(config_.window_frames)) return;
  scores_.pop_front();
  contrast_ratios_.pop_front();
}

}  // namespace posefusion
