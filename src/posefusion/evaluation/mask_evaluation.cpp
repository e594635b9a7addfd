#include "posefusion/evaluation/mask_evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/skeleton/openpose_json.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

constexpr int kFirstPersonLabel = 10;  ///< of the simulator's labels; below is the room
constexpr int kJointReach = 2;         ///< pixels around a joint that may show its person

double Share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Numbers of people by value of the truth image.
using People = std::array<bool, 256>;

/// Whether a square around a joint shows the person with that value.
bool Shows(const cv::Mat& truth, const Joint& joint, int value) {
  const cv::Point centre(static_cast<int>(std::lround(joint.u)),
                         static_cast<int>(std::lround(joint.v)));
  const cv::Rect window = cv::Rect(centre.x - kJointReach, centre.y - kJointReach,
                                   2 * kJointReach + 1, 2 * kJointReach + 1) &
                          cv::Rect({0, 0}, truth.size());
  if (window.empty()) return false;
  cv::Mat same;
  cv::compare(truth(window), value, same, cv::CMP_EQ);
  return cv::countNonZero(same) > 0;
}

/// People with enough joints of one skeleton on them.
People FoundPeople(const cv::Mat& truth, const std::vector<Skeleton>& keypoints, int min_joints) {
  People found{};
  for (int value = 1; value < 256; ++value) {
    for (const Skeleton& skeleton : keypoints) {
      const auto joints = std::count_if(skeleton.begin(), skeleton.end(), [&](const Joint& joint) {
        return joint.p > 0 && Shows(truth, joint, value);
      });
      if (joints >= min_joints) found[static_cast<std::size_t>(value)] = true;
    }
  }
  return found;
}

/// Pixels close to another value than their own.
cv::Mat RimOf(const cv::Mat& truth, int radius_px) {
  cv::Mat low;
  cv::Mat high;
  const cv::Mat square =
      cv::getStructuringElement(cv::MORPH_RECT, {2 * radius_px + 1, 2 * radius_px + 1});
  cv::erode(truth, low, square);
  cv::dilate(truth, high, square);
  cv::Mat rim;
  cv::compare(low, high, rim, cv::CMP_NE);
  return rim;
}

std::int64_t LargestPerson(const cv::Mat& truth, const People& counted) {
  std::array<std::int64_t, 256> sizes{};
  for (int v = 0; v < truth.rows; ++v) {
    const auto* row = truth.ptr<std::uint8_t>(v);
    for (int u = 0; u < truth.cols; ++u) ++sizes[row[u]];
  }
  std::int64_t largest = 0;
  for (std::size_t value = 1; value < sizes.size(); ++value) {
    if (counted[value]) largest = std::max(largest, sizes[value]);
  }
  return largest;
}

void CheckSizes(const cv::Mat& truth, const cv::Mat& estimate, const cv::Mat& depth_m) {
  if (truth.size() == estimate.size() && truth.size() == depth_m.size()) return;
  throw std::invalid_argument("true mask, estimated mask and depth are of different sizes");
}

/// Reads a mask image; colour images count by any channel.
cv::Mat ReadMask(const std::string& path) {
  cv::Mat mask;
  cv::extractChannel(ReadColourImage(path), mask, 0);
  return mask;
}

/// The true people of a frame as ScoreMask wants them.
class TruthFolder {
 public:
  explicit TruthFolder(const std::string& folder)
      : has_labels_(fs::is_directory(folder + "/labels")),
        folder_(folder + (has_labels_ ? "/labels/" : "/masks/")) {
    if (!fs::is_directory(folder_)) {
      throw std::invalid_argument(folder + ": has neither labels/ nor masks/");
    }
  }

  /// Empty when the frame has no truth.
  cv::Mat Read(StampNs stamp_ns) const {
    const std::string path = folder_ + FormatStamp(stamp_ns) + ".png";
    if (!fs::exists(path)) return {};
    cv::Mat truth = ReadMask(path);
    if (has_labels_) {
      truth.setTo(0, truth < kFirstPersonLabel);
      return truth;
    }
    cv::Mat numbers;
    cv::connectedComponents(truth, numbers);
    cv::min(numbers, 255, numbers);
    numbers.convertTo(truth, CV_8U);
    return truth;
  }

 private:
  bool has_labels_;
  std::string folder_;
};

std::vector<Skeleton> ReadKeypoints(const std::string& folder, StampNs stamp_ns) {
  const std::string path = folder + "/" + FormatStamp(stamp_ns) + ".json";
  if (!fs::exists(path)) return {};
  return ReadOpenPoseJson(ReadWholeFile(path), path).people;
}

void Add(const FrameMaskScore& score, const MaskEvaluationConfig& config, MaskEvaluation& all) {
  all.pooled = all.pooled + score.counts;
  all.frames.push_back(score);
  if (score.largest_person_px <= config.min_person_px) return;
  ++all.num_judged;
  if (score.counts.Recall() >= config.good_recall) ++all.num_good;
}

}  // namespace

double MaskCounts::Recall() const { return Share(person_found, person_found + person_missed); }

double MaskCounts::Precision() const { return Share(person_found, person_found + static_taken); }

double MaskCounts::IntersectionOverUnion() const {
  return Share(person_found, person_found + person_missed + static_taken);
}

MaskCounts operator+(const MaskCounts& a, const MaskCounts& b) {
  return {a.person_found + b.person_found, a.person_missed + b.person_missed,
          a.static_taken + b.static_taken};
}

double MaskEvaluation::GoodShare() const { return Share(num_good, num_judged); }

double MaskEvaluation::MeanIou() const {
  double sum = 0;
  int count = 0;
  for (const FrameMaskScore& frame : frames) {
    const MaskCounts& c = frame.counts;
    if (c.person_found + c.person_missed + c.static_taken == 0) continue;
    sum += c.IntersectionOverUnion();
    ++count;
  }
  return count == 0 ? 1.0 : sum / count;
}

FrameMaskScore ScoreMask(const cv::Mat& truth, const cv::Mat& estimate, const cv::Mat& depth_m,
                         const std::vector<Skeleton>* keypoints,
                         const MaskEvaluationConfig& config) {
  CheckSizes(truth, estimate, depth_m);
  People counted{};
  counted.fill(true);
  if (keypoints != nullptr) counted = FoundPeople(truth, *keypoints, config.min_joints);
  const cv::Mat rim = RimOf(truth, config.rim_px);
  FrameMaskScore score;
  score.largest_person_px = LargestPerson(truth, counted);
  for (int v = 0; v < truth.rows; ++v) {
    for (int u = 0; u < truth.cols; ++u) {
      if (!(depth_m.at<float>(v, u) > 0) || rim.at<std::uint8_t>(v, u) != 0) continue;
      const std::uint8_t value = truth.at<std::uint8_t>(v, u);
      const bool taken = estimate.at<std::uint8_t>(v, u) != 0;
      if (value == 0) {
        score.counts.static_taken += taken ? 1 : 0;
      } else if (counted[value]) {
        ++(taken ? score.counts.person_found : score.counts.person_missed);
      }
    }
  }
  return score;
}

MaskEvaluation EvaluateMaskFiles(const MaskEvaluationFiles& files,
                                 const MaskEvaluationConfig& config) {
  if (!fs::is_directory(files.estimate)) {
    throw std::invalid_argument(files.estimate + ": is no folder");
  }
  const TruthFolder truth_folder(files.truth);
  TumFolderSource source(files.truth);
  MaskEvaluation evaluation;
  while (const auto frame = source.Next()) {
    const cv::Mat truth = truth_folder.Read(frame->stamp_ns);
    if (truth.empty()) continue;
    const std::string path = files.estimate + "/" + FormatStamp(frame->stamp_ns) + ".png";
    const bool is_estimated = fs::exists(path);
    if (!is_estimated && files.only_estimated) continue;
    if (!is_estimated) ++evaluation.num_without_estimate;
    const cv::Mat estimate = is_estimated ? ReadMask(path) : cv::Mat::zeros(truth.size(), CV_8UC1);
    std::vector<Skeleton> keypoints;
    if (!files.keypoints.empty()) keypoints = ReadKeypoints(files.keypoints, frame->stamp_ns);
    auto score = ScoreMask(truth, estimate, frame->depth_m,
                           files.keypoints.empty() ? nullptr : &keypoints, config);
    score.stamp_ns = frame->stamp_ns;
    Add(score, config, evaluation);
  }
  return evaluation;
}

}  // namespace posefusion
