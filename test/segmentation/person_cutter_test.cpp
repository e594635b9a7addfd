#include "posefusion/segmentation/person_cutter.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <stdexcept>

#include "posefusion/evaluation/mask_evaluation.h"
#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

class PersonCutterTest : public testing::TestWithParam<MinCutBackend> {
 protected:
  /// The paper's graph has nothing that takes the outline of a body beyond r of the bones.
  static double GoodRecall() { return GetParam() == MinCutBackend::kPcl ? 0.9 : 0.97; }

  static HumanRemovalConfig Config() {
    HumanRemovalConfig config;
    config.min_cut.backend = GetParam();
    return config;
  }

  static cv::Mat Cut(const SyntheticScene& scene) {
    PersonCutter cutter(Config());
    Skeletons skeletons;
    skeletons.people = {scene.Joints()};
    cv::Mat mask;
    cutter.Cut(scene.Render(), skeletons, mask);
    return mask;
  }

  static MaskCounts Score(const SyntheticScene& scene, const cv::Mat& mask) {
    return ScoreMask(scene.TrueMask(), mask, scene.Render().depth_m, nullptr, {}).counts;
  }
};

TEST_P(PersonCutterTest, CutsAPersonWhoStandsOnTheFloor) {
  SyntheticScene scene;
  scene.person_m = 3.0;
  scene.wall_m = 4.5;
  const MaskCounts counts = Score(scene, Cut(scene));
  EXPECT_GT(counts.Recall(), GoodRecall());
  EXPECT_GT(counts.Precision(), 0.93);
}

TEST_P(PersonCutterTest, CutsAPersonSeenThroughALens) {
  SyntheticScene scene;
  scene.camera = DistortedCamera();
  scene.person_x_m = -0.7;
  const MaskCounts counts = Score(scene, Cut(scene));
  EXPECT_GT(counts.Recall(), GoodRecall());
  EXPECT_GT(counts.Precision(), 0.95);
}

TEST_P(PersonCutterTest, CutsAPersonAtTheBorderOfTheImage) {
  SyntheticScene scene;
  scene.person_x_m = 1.2;
  const MaskCounts counts = Score(scene, Cut(scene));
  EXPECT_GT(counts.Recall(), GoodRecall());
  EXPECT_GT(counts.Precision(), 0.95);
}

/// Legs without joints, in a picture that shows them beside the body.
TEST_P(PersonCutterTest, CutsLegsWithoutJointsAlongGravity) {
  SyntheticScene scene;
  scene.person_m = 3.0;
  scene.wall_m = 4.5;
  Skeleton joints = scene.Joints();
  for (const CocoJoint joint : {kRightKnee, kLeftKnee, kRightAnkle, kLeftAnkle}) joints[joint] = {};
  Skeletons skeletons;
  skeletons.people = {Rolled(joints, scene.camera)};
  const RgbdFrame frame = Rolled(scene.Render());
  cv::Mat truth;
  cv::rotate(scene.TrueMask(), truth, cv::ROTATE_90_COUNTERCLOCKWISE);
  HumanRemovalConfig config = Config();
  config.min_cut.data_term = DataTerm::kPenalty;
  config.min_cut.penalty_distance = PenaltyDistance::kPlane;
  PersonCutter cutter(config);
  CutRequest request;
  request.skeletons = &skeletons;
  const auto recall = [&] {
    cv::Mat mask;
    cutter.Cut(frame, request, mask);
    return ScoreMask(truth, mask, frame.depth_m, nullptr, {}).counts.Recall();
  };
  const double without = recall();
  request.gravity = Eigen::Vector3f::UnitX();
  EXPECT_GT(recall(), GoodRecall());
  EXPECT_LT(without, 0.85);
}

TEST_P(PersonCutterTest, CutsNothingOutOfAWall) {
  SyntheticScene scene;
  scene.wall_m = scene.person_m;
  EXPECT_EQ(cv::countNonZero(Cut(scene)), 0);
}

TEST_P(PersonCutterTest, CutsFromCertainCells) {
  SyntheticScene scene;
  scene.person_m = 3.0;
  scene.wall_m = 4.5;
  const RgbdFrame frame = scene.Render();
  PersonCutter cutter(Config());
  CutRequest request;
  request.cell_seeds.resize(1);
  request.cell_seeds[0].person = cv::Mat::zeros(cutter.CellSize(frame), CV_8UC1);
  request.cell_seeds[0].person(cv::Rect(75, 45, 11, 60)).setTo(255);
  cv::Mat mask;
  cutter.Cut(frame, request, mask);
  const MaskCounts counts = Score(scene, mask);
  EXPECT_GT(counts.Recall(), 0.9);
  EXPECT_GT(counts.Precision(), 0.9);
}

TEST_P(PersonCutterTest, GivesTheSameMaskWhateverCameBefore) {
  SyntheticScene scene;
  const cv::Mat first = Cut(scene);
  PersonCutter cutter(Config());
  Skeletons skeletons;
  SyntheticScene other;
  other.person_x_m = 0.5;
  skeletons.people = {other.Joints()};
  cv::Mat mask;
  cutter.Cut(other.Render(), skeletons, mask);
  skeletons.people = {scene.Joints()};
  cutter.Cut(scene.Render(), skeletons, mask);
  EXPECT_EQ(cv::norm(first, mask, cv::NORM_INF), 0);
}

TEST_P(PersonCutterTest, CutsNobodyWithoutSkeletons) {
  PersonCutter cutter(Config());
  cv::Mat mask;
  cutter.Cut(SyntheticScene().Render(), Skeletons(), mask);
  EXPECT_EQ(mask.size(), cv::Size(640, 480));
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, PersonCutterTest,
                         testing::Values(MinCutBackend::kPcl, MinCutBackend::kGrid),
                         [](const auto& info) {
                           return std::string(info.param == MinCutBackend::kPcl ? "Pcl" : "Grid");
                         });

/// Where the trees are made to deny everybody, equation 3 finds them by its share.
TEST(PersonCutter, GivesEquation3ItsShareOfTheLearnedDataTerm) {
  SyntheticScene scene;
  HumanRemovalConfig config;
  config.min_cut.log_odds_offset = -10;
  Skeletons skeletons;
  skeletons.people = {scene.Joints()};
  const RgbdFrame frame = scene.Render();
  const auto recall = [&](double penalty_weight) {
    config.min_cut.penalty_weight = penalty_weight;
    cv::Mat mask;
    PersonCutter(config).Cut(frame, skeletons, mask);
    return ScoreMask(scene.TrueMask(), mask, frame.depth_m, nullptr, {}).counts.Recall();
  };
  EXPECT_LT(recall(0), 0.5);
  EXPECT_GT(recall(100), 0.85) << "edges weigh nothing beside it";
}

TEST(PersonCutter, RefusesValuesOutOfRangeByName) {
  HumanRemovalConfig config;
  config.min_cut.radius_m = -1;
  try {
    PersonCutter cutter(config);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("human_removal.min_cut.radius_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace posefusion
