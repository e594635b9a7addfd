#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>

#include "posefusion/image/sharpness.h"

namespace posefusion {

/// What the score of an image is compared with.
enum class BlurMode {
  kAbsolute,  ///< a fixed threshold, as in the paper; depends on camera, room and exposure
  kRelative,  ///< a share of the running median of recent scores
};

struct BlurFilterConfig {
  bool enabled = true;
  BlurMode mode = BlurMode::kRelative;
  double threshold = 100;            ///< absolute mode: scores below are blurred [grey levels^2]
  double relative_threshold = 0.42;  ///< relative mode: share of the running median score
  /// Relative mode: an image is blurred only when score / contrast is below this share of its own
  /// running median too. Otherwise it shows less than before, it does not show it less sharply.
  double contrast_ratio_threshold = 0.5;
  int window_frames = 30;         ///< kept frames that make up the running medians
  int max_consecutive_drops = 5;  ///< then one frame is kept whatever its score
  double min_contrast = 100;      ///< below it an image has no texture to judge by [grey levels^2]
  /// Takes the share of sensor noise, up to this standard deviation, out of the score: noise is as
  /// strong in a blurred image and hides the loss of edges. 0 = the score as in the paper.
  double max_noise_grey_levels = 3;
};

template <class V>
void Describe(V& v, BlurFilterConfig& c) {
  v.Field("enabled", c.enabled);
  v.Choice("mode", c.mode, {"absolute", "relative"});
  v.Field("threshold", c.threshold, 0.0, 1e6);
  v.Field("relative_threshold", c.relative_threshold, 0.0, 1.0);
  v.Field("contrast_ratio_threshold", c.contrast_ratio_threshold, 0.0, 10.0);
  v.Field("window_frames", c.window_frames, 1, 1000);
  v.Field("max_consecutive_drops", c.max_consecutive_drops, 0, 1000);
  v.Field("min_contrast", c.min_contrast, 0.0, 1e6);
  v.Field("max_noise_grey_levels", c.max_noise_grey_levels, 0.0, 50.0);
}

/// Why a frame is kept or dropped.
enum class BlurReason {
  kDisabled,      ///< kept: the filter is off, nothing was measured
  kSharp,         ///< kept
  kLessContrast,  ///< kept: a low score, but the image shows that much less in all
  kNoTexture,     ///< kept: nothing to judge by, such as a white wall
  kDropLimit,     ///< kept although blurred, after max_consecutive_drops dropped ones
  kBlurred,       ///< dropped
};

const char* ToString(BlurReason reason);

struct BlurDecision {
  bool keep = true;
  double score = 0;      ///< variance of the Laplacian, less noise [grey levels^2]
  double threshold = 0;  ///< what the score was compared with; 0 before the first frame
  BlurReason reason = BlurReason::kSharp;
};

/// Numbers of frames, as in Table I of the paper.
struct BlurCounts {
  int seen = 0;
  int dropped = 0;
};

/// Decides which frames are too blurred to be used (paper, section III-A). Frames come in stamp
/// order; the same frames give the same decisions. Not thread-safe.
///
/// The running medians are of kept frames with texture, those kept by the drop limit included. So a
/// blurred stretch has to last window_frames / 2 * (max_consecutive_drops + 1) frames (3 s at 30
/// Hz) before it passes for normal, a room of weaker texture is accepted after that time at the
/// latest, and a wall in between is forgotten at once.
class BlurFilter {
 public:
  /// @throws std::invalid_argument naming the key for a value out of range.
  explicit BlurFilter(const BlurFilterConfig& config);

  /// Judges the next frame's colour image (CV_8UC3, R G B).
  /// @throws std::invalid_argument for an empty image or another type.
  BlurDecision Judge(const cv::Mat& rgb);

  const BlurCounts& counts() const { return counts_; }
  const BlurFilterConfig& config() const { return config_; }

 private:
  double Score(const ImageSharpness& sharpness) const;
  BlurDecision Compare(double score, double contrast) const;
  void Remember(double score, double contrast);

  const BlurFilterConfig config_;
  std::deque<double> scores_;           ///< of the last frames that count
  std::deque<double> contrast_ratios_;  ///< score / contrast of the same frames
  int consecutive_drops_ = 0;
  BlurCounts counts_;
};

}  // namespace posefusion
