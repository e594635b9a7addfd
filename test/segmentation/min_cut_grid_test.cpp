#include "posefusion/segmentation/min_cut_grid.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "posefusion/segmentation/people_memory.h"
#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

/// A table seen from above with a ridge across the image, 7 cm wide and 4 cm high, such as a
/// forearm. One seed lies in its middle.
class RidgeOnATable : public testing::Test {
 protected:
  static constexpr float kTable = 1.2F;  ///< metres
  static constexpr int kFirstRow = 56;
  static constexpr int kLastRow = 63;
  static constexpr int kMiddle = 80;

  RidgeOnATable() {
    CameraModel camera = SyntheticScene().Render().camera;
    cv::Mat depth_m(camera.height, camera.width, CV_32FC1, cv::Scalar(kTable));
    const int size = CellGridConfig().size_px;
    depth_m.rowRange(kFirstRow * size, (kLastRow + 1) * size).setTo(kTable - 0.04F);
    cells_.Build(depth_m, camera);
    problem_.radius_m = config_.radius_m;
    problem_.source_weight = config_.source_weight;
    problem_.cells = &cells_;
    problem_.region = cv::Rect({0, 0}, cells_.size());
    problem_.states.Resize(cells_.width(), cells_.height());
    SetStates(CellState::kSurface);
    problem_.seeds = {{cells_.PointAt(kMiddle, 60)}};
    problem_.states.at(kMiddle, 60) = CellState::kPerson;
  }

  void SetStates(CellState table) {
    for (int y = 0; y < cells_.height(); ++y) {
      const bool is_ridge = y >= kFirstRow && y <= kLastRow;
      for (int x = 0; x < cells_.width(); ++x) {
        problem_.states.at(x, y) = is_ridge ? CellState::kFree : table;
      }
    }
  }

  cv::Mat Solve() const {
    cv::Mat person;
    MinCutGrid(config_).Solve(problem_, person);
    return person;
  }

  int NumPersonCells() const { return cv::countNonZero(Solve()); }

  MinCutConfig config_;
  CellGrid cells_{CellGridConfig()};
  CutProblem problem_;
};

/// The half of the ridge that has the colour of the room is not the person's.
TEST_F(RidgeOnATable, EndsWhereTheColoursOfPeopleEnd) {
  const cv::Scalar skin(200, 150, 120);
  const cv::Scalar wood(120, 90, 60);
  problem_.colours = cv::Mat(cells_.size(), CV_8UC3, wood);
  problem_.colours.colRange(0, kMiddle + 1).setTo(skin);
  CellPeople people;
  people.Forget(cells_.size());
  people.evidence.Fill(1);
  for (int y = 0; y < cells_.height(); ++y) {
    for (int x = 0; x < cells_.width(); ++x) people.person.at(x, y) = x <= kMiddle ? 1 : kNobody;
  }
  PeopleColours colours{PeopleColoursConfig()};
  colours.Add(problem_.colours, people, cv::Mat(cells_.size(), CV_8UC1, cv::Scalar(kOnSeeds)));
  config_.colour_sigma = 100000;  // edges know no colours
  const cv::Mat by_distance = Solve();
  EXPECT_EQ(by_distance.at<std::uint8_t>(60, kMiddle + 10), 255);
  EXPECT_EQ(by_distance.at<std::uint8_t>(60, kMiddle - 30), 0);
  problem_.people_colours = &colours;
  problem_.colour_weight = 0.1;
  const cv::Mat by_colours = Solve();
  EXPECT_EQ(by_colours.at<std::uint8_t>(60, kMiddle + 10), 0);
  EXPECT_EQ(by_colours.at<std::uint8_t>(60, kMiddle - 30), 255);
}

TEST_F(RidgeOnATable, EndsAtTheTable) {
  const int along_16_cm = 2 * 17 * (kLastRow - kFirstRow + 1);
  EXPECT_GT(NumPersonCells(), along_16_cm / 2);
  config_.surface_edge_share = 1;  // then the edge costs more than the limb
  EXPECT_LT(NumPersonCells(), along_16_cm / 4);
}

TEST_F(RidgeOnATable, IsShorterForAThinPartOfTheBody) {
  const int trunk = NumPersonCells();
  problem_.seeds[0].radius_share = 0.6F;
  const int limb = NumPersonCells();
  EXPECT_GT(limb, 0);
  EXPECT_LT(limb, trunk * 3 / 4);
}

TEST_F(RidgeOnATable, GoesOnWhereALimbLeavesTheImage) {
  SetStates(CellState::kOutside);
  config_.reach_m = 0.2;
  const int known = NumPersonCells();
  problem_.unseen_parts = {{problem_.seeds[0].p_camera, 0.5F, false}};
  const int hidden = NumPersonCells();
  problem_.unseen_parts[0].leaves_image = true;
  const int leaving = NumPersonCells();
  EXPECT_LT(hidden, known * 3 / 2);
  EXPECT_GT(leaving, 2 * known);
}

}  // namespace
}  // namespace posefusion
