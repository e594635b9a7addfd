// Masks of real people, from the keypoints that a small network found of them. The pictures are not
// in the repository.

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/evaluation/mask_evaluation.h"
#include "posefusion/segmentation/person_cutter.h"
#include "posefusion/skeleton/openpose_json.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;

/// A frame, the keypoints in it, and what was cut out by them.
struct CutFrame {
  RgbdFrame frame;
  Skeletons skeletons;
  cv::Mat mask;
};

/// Cuts people out of all frames of a folder that have keypoints.
int CutFolder(const std::string& folder, const std::function<void(const CutFrame&)>& look_at) {
  PersonCutter cutter{HumanRemovalConfig()};
  TumFolderSource source(folder);
  int num_frames = 0;
  while (auto frame = source.Next()) {
    CutFrame cut;
    cut.frame = std::move(*frame);
    const std::string json = folder + "/keypoints/" + FormatStamp(cut.frame.stamp_ns) + ".json";
    if (!fs::exists(json)) continue;
    cut.skeletons.stamp_ns = cut.frame.stamp_ns;
    cut.skeletons.people = ReadOpenPoseJson(ReadWholeFile(json), json).people;
    cutter.Cut(cut.frame, cut.skeletons, cut.mask);
    look_at(cut);
    ++num_frames;
  }
  return num_frames;
}

/// Share of the certain joints that the mask covers.
double ShareOfJoints(const CutFrame& cut) {
  constexpr float kCertain = 0.4F;
  int num_joints = 0;
  int num_covered = 0;
  for (const Skeleton& person : cut.skeletons.people) {
    for (const Joint& joint : person) {
      const cv::Point pixel(static_cast<int>(joint.u), static_cast<int>(joint.v));
      if (joint.p < kCertain || !cv::Rect({0, 0}, cut.mask.size()).contains(pixel)) continue;
      ++num_joints;
      if (cut.mask.at<std::uint8_t>(pixel) != 0) ++num_covered;
    }
  }
  EXPECT_GT(num_joints, 0);
  return static_cast<double>(num_covered) / num_joints;
}

TEST(RealPeople, MaskOfATurningManIsHisLabel) {
  SKIP_WITHOUT_DATA("people_pictures/uva_turning");
  const std::string folder = DataPath("people_pictures/uva_turning");
  MaskEvaluation evaluation;
  CutFolder(folder, [&](const CutFrame& cut) {
    const std::string name = folder + "/masks/" + FormatStamp(cut.frame.stamp_ns) + ".png";
    cv::Mat truth;
    cv::extractChannel(ReadColourImage(name), truth, 0);
    evaluation.frames.push_back(ScoreMask(truth, cut.mask, cut.frame.depth_m, nullptr, {}));
  });
  EXPECT_EQ(evaluation.frames.size(), 5U);
  EXPECT_GT(evaluation.MeanIou(), 0.98);
}

TEST(RealPeople, MasksCoverTheJointsAndLeaveTheRoom) {
  SKIP_WITHOUT_DATA("people_pictures");
  constexpr double kMaxShareOfImage = 0.6;  // two people close before the camera take half
  int num_frames = 0;
  for (const auto& entry : fs::directory_iterator(DataPath("people_pictures"))) {
    if (!entry.is_directory()) continue;
    num_frames += CutFolder(entry.path(), [&](const CutFrame& cut) {
      EXPECT_GT(ShareOfJoints(cut), 0.9) << entry.path() << " " << cut.frame.stamp_ns;
      const double taken = cv::countNonZero(cut.mask) / static_cast<double>(cut.mask.total());
      EXPECT_LT(taken, kMaxShareOfImage) << entry.path() << " " << cut.frame.stamp_ns;
    });
  }
  EXPECT_EQ(num_frames, 21);
}

}  // namespace
}  // namespace posefusion
