#include "posefusion/evaluation/mask_evaluation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "posefusion/evaluation/mask_report.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

constexpr std::uint8_t kAnna = 10;
constexpr std::uint8_t kBert = 11;

/// Two people of 40 x 60 px in an image of 200 x 100.
cv::Mat Truth() {
  cv::Mat truth = cv::Mat::zeros(100, 200, CV_8UC1);
  truth(cv::Rect(20, 20, 40, 60)).setTo(kAnna);
  truth(cv::Rect(120, 20, 40, 60)).setTo(kBert);
  return truth;
}

cv::Mat Depth() { return cv::Mat(100, 200, CV_32FC1, cv::Scalar(2)); }

TEST(ScoreMask, CountsWhatWasFoundMissedAndTaken) {
  cv::Mat estimate = cv::Mat::zeros(100, 200, CV_8UC1);
  estimate(cv::Rect(20, 20, 40, 30)).setTo(255);  // the upper half of one
  estimate(cv::Rect(80, 40, 10, 10)).setTo(255);  // nobody
  MaskEvaluationConfig config;
  config.rim_px = 0;
  const FrameMaskScore score = ScoreMask(Truth(), estimate, Depth(), nullptr, config);
  EXPECT_EQ(score.counts.person_found, 1200);
  EXPECT_EQ(score.counts.person_missed, 3600);
  EXPECT_EQ(score.counts.static_taken, 100);
  EXPECT_EQ(score.largest_person_px, 2400);
  EXPECT_DOUBLE_EQ(score.counts.Recall(), 0.25);
}

TEST(ScoreMask, LeavesTheRimAndPixelsWithoutDepthOut) {
  cv::Mat estimate = cv::Mat::zeros(100, 200, CV_8UC1);
  estimate(cv::Rect(17, 17, 46, 66)).setTo(255);  // 3 px too large
  cv::Mat depth = Depth();
  depth.colRange(100, 200).setTo(0);
  const MaskCounts counts = ScoreMask(Truth(), estimate, depth, nullptr, {}).counts;
  EXPECT_EQ(counts.person_found, 34 * 54);
  EXPECT_EQ(counts.person_missed, 0);
  EXPECT_EQ(counts.static_taken, 0);
}

TEST(ScoreMask, IgnoresPeopleWithoutKeypoints) {
  Skeleton skeleton{};
  skeleton[kNose] = {40, 30, 0.5F};
  skeleton[kNeck] = {40, 40, 0.5F};
  skeleton[kRightHip] = {40, 60, 0.5F};
  skeleton[kLeftHip] = {140, 60, 0.5F};
  const std::vector<Skeleton> keypoints = {skeleton};
  const cv::Mat nobody = cv::Mat::zeros(100, 200, CV_8UC1);
  const cv::Mat everybody = Truth();
  const MaskCounts missed = ScoreMask(Truth(), nobody, Depth(), &keypoints, {}).counts;
  EXPECT_EQ(missed.person_missed, 34 * 54) << "Bert has one joint only";
  const MaskCounts found = ScoreMask(Truth(), everybody, Depth(), &keypoints, {}).counts;
  EXPECT_EQ(found.person_found, 34 * 54);
  EXPECT_EQ(found.static_taken, 0) << "Bert is no background either";
}

TEST(ScoreMask, RefusesImagesOfDifferentSizes) {
  EXPECT_THROW(ScoreMask(Truth(), cv::Mat::zeros(50, 50, CV_8UC1), Depth(), nullptr, {}),
               std::invalid_argument);
}

/// A folder with two frames: one estimated well, one without an estimate.
class EvaluateMaskFilesTest : public testing::Test {
 protected:
  EvaluateMaskFilesTest() {
    for (const char* name : {"rgb", "depth", "labels", "masks"}) {
      std::filesystem::create_directories(folder_ / name);
    }
    std::ofstream(folder_ / "camera.yaml")
        << "width: 200\nheight: 100\nfx: 200\nfy: 200\ncx: 99.5\ncy: 49.5\ndepth_scale: 5000\n";
    for (const std::string stamp : {"1.000000", "2.000000"}) {
      const std::string file = stamp + ".png";
      cv::imwrite(folder_ / ("rgb/" + file), cv::Mat::zeros(100, 200, CV_8UC3));
      cv::imwrite(folder_ / ("depth/" + file), cv::Mat(100, 200, CV_16UC1, cv::Scalar(9000)));
      cv::imwrite(folder_ / ("labels/" + file), Truth());
      std::ofstream(folder_ / "rgb.txt", std::ios::app) << stamp << " rgb/" << file << "\n";
      std::ofstream(folder_ / "depth.txt", std::ios::app) << stamp << " depth/" << file << "\n";
    }
    cv::imwrite(folder_ / "masks/1.000000.png", Truth() * 20);
    files_.truth = folder_.path();
    files_.estimate = folder_ / "masks";
  }

  TemporaryFolder folder_;
  MaskEvaluationFiles files_;
};

TEST_F(EvaluateMaskFilesTest, CountsFramesWithoutMaskAsNobodyFound) {
  const MaskEvaluation evaluation = EvaluateMaskFiles(files_, {});
  EXPECT_EQ(evaluation.frames.size(), 2U);
  EXPECT_EQ(evaluation.num_without_estimate, 1);
  EXPECT_DOUBLE_EQ(evaluation.pooled.Recall(), 0.5);
  EXPECT_EQ(evaluation.num_judged, 2);
  EXPECT_EQ(evaluation.num_good, 1);
  const nlohmann::json json = ToJson(evaluation, {});
  EXPECT_EQ(json["worst_frames"][0]["stamp"], "2.000000");
  EXPECT_EQ(json["worst_frames"].size(), 1U);
}

TEST(MaskEvaluation, MeanOfFramesLeavesThoseOutWithNothingToFind) {
  MaskEvaluation evaluation;
  EXPECT_EQ(evaluation.MeanIou(), 1.0);
  for (const MaskCounts& counts : {MaskCounts{90, 10, 0}, {1, 0, 1}, {0, 0, 0}, {0, 5, 0}}) {
    FrameMaskScore score;
    score.counts = counts;
    evaluation.frames.push_back(score);
  }
  EXPECT_DOUBLE_EQ(evaluation.MeanIou(), (0.9 + 0.5 + 0.0) / 3);
}

TEST_F(EvaluateMaskFilesTest, LeavesFramesWithoutMaskOutWhenAsked) {
  files_.only_estimated = true;
  const MaskEvaluation evaluation = EvaluateMaskFiles(files_, {});
  EXPECT_EQ(evaluation.frames.size(), 1U);
  EXPECT_DOUBLE_EQ(evaluation.pooled.Recall(), 1.0);
  EXPECT_DOUBLE_EQ(evaluation.pooled.Precision(), 1.0);
}

TEST_F(EvaluateMaskFilesTest, NamesAFolderWithoutTruth) {
  files_.estimate = folder_ / "nothing";
  EXPECT_THROW(EvaluateMaskFiles(files_, {}), std::invalid_argument);
  std::filesystem::remove_all(folder_ / "labels");
  std::filesystem::remove_all(folder_ / "masks");
  files_.estimate = folder_ / "rgb";
  EXPECT_THROW(EvaluateMaskFiles(files_, {}), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
