#include "posefusion/segmentation/min_cut_grid.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

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

  int NumPersonCells() {
    cv::Mat person;
    MinCutGrid(config_).Solve(problem_, person);
    return cv::countNonZero(person);
  }

  MinCutConfig config_;
  CellGrid cells_{CellGridConfig()};
  CutProblem problem_;
};

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
