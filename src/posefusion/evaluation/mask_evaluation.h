#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

struct MaskEvaluationConfig {
  int rim_px = 3;             ///< pixels this close to the border of a true person do not count
  int min_person_px = 2000;   ///< a frame is judged by its own recall when a person has more
  double good_recall = 0.85;  ///< of such a frame
  int min_joints = 3;         ///< people with fewer keypoints on them do not count
  int num_worst = 10;         ///< frames listed
};

/// Pixels that count, by what they are and what they were taken for.
struct MaskCounts {
  std::int64_t person_found = 0;
  std::int64_t person_missed = 0;
  std::int64_t static_taken = 0;

  /// 1 where there is nothing to find, or nothing was found.
  double Recall() const;
  double Precision() const;
  double IntersectionOverUnion() const;
};

MaskCounts operator+(const MaskCounts& a, const MaskCounts& b);

struct FrameMaskScore {
  StampNs stamp_ns = 0;
  MaskCounts counts;
  std::int64_t largest_person_px = 0;  ///< with or without depth, of the people that count
};

struct MaskEvaluation {
  MaskCounts pooled;
  std::vector<FrameMaskScore> frames;  ///< with a truth, in the order of stamps
  int num_without_estimate = 0;        ///< of these: they count as if nobody had been found
  int num_judged = 0;                  ///< frames with a person of more than min_person_px
  int num_good = 0;                    ///< of these with good_recall

  double GoodShare() const;
  /// Mean of the frames' own intersection over union, those in which nobody is and nobody was found
  /// left out; 1 when none is left.
  double MeanIou() const;
};

/// Scores one mask. `truth` (CV_8UC1): 0 = static, other values are people, a value for each;
/// `estimate` (CV_8UC1): not 0 = person; only pixels with `depth_m` (CV_32FC1) > 0 count, and none
/// close to a border between a person and anything else. People without `min_joints` keypoints on
/// them are neither expected nor forbidden when `keypoints` is given.
FrameMaskScore ScoreMask(const cv::Mat& truth, const cv::Mat& estimate, const cv::Mat& depth_m,
                         const std::vector<Skeleton>* keypoints,
                         const MaskEvaluationConfig& config);

struct MaskEvaluationFiles {
  std::string truth;            ///< folder in TUM format with labels/ (>= 10 is a person) or masks/
  std::string estimate;         ///< folder with <stamp>.png, not 0 = person
  std::string keypoints;        ///< OpenPose JSON by stamp; "" = everybody counts
  bool only_estimated = false;  ///< leaves out frames without an estimate
};

/// @throws std::invalid_argument or std::runtime_error naming the file that cannot be used.
MaskEvaluation EvaluateMaskFiles(const MaskEvaluationFiles& files,
                                 const MaskEvaluationConfig& config);

}  // namespace posefusion
