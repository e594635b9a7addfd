#include "posefusion/segmentation/min_cut.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "posefusion/segmentation/seeds.h"
#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

/// The whole image as one problem with the seeds of the person; what is farther than the person by
/// `depth_behind_m` is left out.
class MinCutTest : public testing::TestWithParam<MinCutBackend> {
 protected:
  /// The paper's graph has nothing that takes the outline of a body beyond r of the bones.
  static double GoodRecall() { return GetParam() == MinCutBackend::kPcl ? 0.9 : 0.97; }

  void Prepare(const SyntheticScene& scene, double depth_behind_m) {
    const RgbdFrame frame = scene.Render();
    cells_.Build(frame.depth_m, frame.camera);
    truth_ = scene.TrueMask();
    problem_.cells = &cells_;
    problem_.region = cv::Rect({0, 0}, cells_.size());
    problem_.states.Resize(cells_.width(), cells_.height());
    for (int y = 0; y < cells_.height(); ++y) {
      for (int x = 0; x < cells_.width(); ++x) {
        const bool near = cells_.DepthAt(x, y) < scene.person_m + depth_behind_m;
        problem_.states.at(x, y) = near ? CellState::kFree : CellState::kOutside;
      }
    }
    for (const Seed& seed : LiftPerson(scene.Joints(), frame, SeedConfig()).seeds) {
      problem_.seeds.push_back(seed.OnBody());
    }
  }

  /// A wall with one seed in its middle.
  void PrepareWall() {
    const CameraModel camera = SyntheticScene().camera;
    cells_.Build(cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(2)), camera);
    problem_ = CutProblem();
    problem_.radius_m = MinCutConfig().radius_m;
    problem_.source_weight = 2;  // a single seed against all edges around it
    problem_.cells = &cells_;
    problem_.region = cv::Rect({0, 0}, cells_.size());
    problem_.states.Resize(cells_.width(), cells_.height());
    problem_.states.Fill(CellState::kFree);
    problem_.states.at(80, 60) = CellState::kPerson;
    problem_.seeds.push_back({cells_.PointAt(80, 60)});
  }

  cv::Mat Solve(PenaltyDistance distance = PenaltyDistance::kSpace) const {
    MinCutConfig config;
    config.penalty_distance = distance;
    config.backend = GetParam();
    cv::Mat person;
    MakeMinCut(config)->Solve(problem_, person);
    return person;
  }

  bool IsTrue(int x, int y) const { return truth_.at<std::uint8_t>(4 * y + 2, 4 * x + 2) != 0; }

  /// Share of the person's cells, and of the others, that were taken for the person. The lowest
  /// cells, where person and floor meet, are left out.
  std::pair<double, double> Shares(const cv::Mat& person) const {
    double found = 0, people = 0, taken = 0;
    for (int y = 0; y < cells_.height() - 15; ++y) {
      for (int x = 0; x < cells_.width(); ++x) {
        const bool is_found = person.at<std::uint8_t>(y, x) != 0;
        people += IsTrue(x, y) ? 1 : 0;
        found += IsTrue(x, y) && is_found ? 1 : 0;
        taken += !IsTrue(x, y) && is_found ? 1 : 0;
      }
    }
    return {found / people, taken / people};
  }

  CellGrid cells_{CellGridConfig()};
  cv::Mat truth_;
  CutProblem problem_;
};

TEST_P(MinCutTest, SeparatesAPersonFromAWall) {
  Prepare(SyntheticScene(), 0.5);
  const auto [found, taken] = Shares(Solve());
  EXPECT_GT(found, GoodRecall());
  EXPECT_LT(taken, 0.03);
}

TEST_P(MinCutTest, SeparatesAPersonOffTheAxis) {
  SyntheticScene scene;
  scene.person_x_m = 0.8;
  Prepare(scene, 0.5);
  const auto [found, taken] = Shares(Solve());
  EXPECT_GT(found, GoodRecall());
  EXPECT_LT(taken, 0.03);
}

TEST_P(MinCutTest, KeepsCertainCells) {
  Prepare(SyntheticScene(), 0.5);
  problem_.states.at(80, 60) = CellState::kBackground;  // in the middle of the person
  problem_.states.at(20, 118) = CellState::kPerson;     // on the floor
  const cv::Mat person = Solve();
  EXPECT_EQ(person.at<std::uint8_t>(60, 80), 0);
  EXPECT_EQ(person.at<std::uint8_t>(118, 20), 255);
}

TEST_P(MinCutTest, EndsAtAnEdgeOfColour) {
  if (GetParam() == MinCutBackend::kPcl) GTEST_SKIP() << "pcl knows no colours";
  constexpr int kEdge = 90;
  SyntheticScene scene;
  CameraModel camera = scene.Render().camera;
  cells_.Build(cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(1.5)), camera);
  problem_ = CutProblem();
  problem_.radius_m = MinCutConfig().radius_m;
  problem_.source_weight = MinCutConfig().source_weight;
  problem_.cells = &cells_;
  problem_.region = cv::Rect({0, 0}, cells_.size());
  problem_.states.Resize(cells_.width(), cells_.height());
  problem_.states.Fill(CellState::kFree);
  for (int y = 40; y < 80; ++y) {
    problem_.states.at(80, y) = CellState::kPerson;
    problem_.seeds.push_back({cells_.PointAt(80, y)});
  }
  problem_.colours = cv::Mat(cells_.size(), CV_8UC3, cv::Scalar(40, 60, 80));
  problem_.colours.colRange(kEdge, cells_.width()).setTo(cv::Scalar(180, 150, 120));
  const cv::Mat person = Solve();
  EXPECT_EQ(person.at<std::uint8_t>(60, kEdge - 1), 255);
  EXPECT_EQ(person.at<std::uint8_t>(60, kEdge + 1), 0);
}

/// In the horizontal plane everything above and below a seed is near it.
TEST_P(MinCutTest, TakesThePenaltyInTheHorizontalPlaneWhereGravityIsKnown) {
  PrepareWall();
  const cv::Point below(80, 110);
  const cv::Point right(130, 60);
  const auto is_person = [&](const cv::Mat& person, const cv::Point& cell) {
    return person.at<std::uint8_t>(cell) != 0;
  };
  problem_.gravity = Eigen::Vector3f::UnitY();
  const cv::Mat level = Solve(PenaltyDistance::kPlane);
  EXPECT_TRUE(is_person(level, below) && !is_person(level, right));
  problem_.gravity = Eigen::Vector3f::UnitX();
  const cv::Mat rolled = Solve(PenaltyDistance::kPlane);
  EXPECT_TRUE(is_person(rolled, right) && !is_person(rolled, below));
  problem_.gravity = Eigen::Vector3f::UnitZ();
  const cv::Mat from_above = Solve(PenaltyDistance::kPlane);
  EXPECT_FALSE(is_person(from_above, right) || is_person(from_above, below));
  problem_.gravity.reset();
  EXPECT_EQ(cv::norm(from_above, Solve(PenaltyDistance::kPlane), cv::NORM_INF), 0)
      << "the image plane";
}

TEST_P(MinCutTest, FindsNobodyWithoutVertices) {
  Prepare(SyntheticScene(), 0.5);
  problem_.states.Fill(CellState::kOutside);
  EXPECT_EQ(cv::countNonZero(Solve()), 0);
}

TEST_P(MinCutTest, GivesTheSameCutTwice) {
  Prepare(SyntheticScene(), 2);
  const cv::Mat first = Solve();
  EXPECT_EQ(cv::norm(first, Solve(), cv::NORM_INF), 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, MinCutTest,
                         testing::Values(MinCutBackend::kPcl, MinCutBackend::kGrid),
                         [](const auto& info) {
                           return std::string(info.param == MinCutBackend::kPcl ? "Pcl" : "Grid");
                         });

TEST(RotationToPenaltyFrame, TurnsGravityIntoZ) {
  const Eigen::Vector3f down = Eigen::Vector3f(0.1F, 0.9F, 0.3F).normalized();
  EXPECT_LT((RotationToPenaltyFrame(down) * down - Eigen::Vector3f::UnitZ()).norm(), 1e-5F);
  EXPECT_TRUE(RotationToPenaltyFrame(std::nullopt).isIdentity());
}

}  // namespace
}  // namespace posefusion
