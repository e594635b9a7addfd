#include "posefusion/evaluation/map_evaluation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "posefusion/common/lie.h"
#include "test/evaluation/sample_room.h"

namespace posefusion {
namespace {

constexpr double kRoundingM = 1e-5;      ///< of floats and of the alignment
constexpr double kSamplingError = 0.03;  ///< relative, of areas by about ten thousand samples

void MoveMap(const Eigen::Isometry3d& T_other_map, SurfelCloud& map) {
  const Eigen::Isometry3f T = T_other_map.cast<float>();
  for (auto& position : map.position_m) position = T * position;
  for (auto& normal : map.normal) normal = T.linear() * normal;
}

Trajectory InOtherMap(Trajectory trajectory, const Eigen::Isometry3d& T_other_map) {
  for (StampedPose& pose : trajectory) pose.T_map_camera = T_other_map * pose.T_map_camera;
  return trajectory;
}

TEST(MapEvaluation, OffsetOfAWallIsItsError) {
  const MapTruth truth = RoomTruth();
  const MapEvaluation evaluation = EvaluateMap(WallMap(0.013F, -1, 1), truth.trajectory, truth);
  EXPECT_EQ(evaluation.all_m.count, 100 * 200);
  EXPECT_NEAR(evaluation.all_m.mean, 0.013, kRoundingM);
  EXPECT_NEAR(evaluation.all_m.median, 0.013, kRoundingM);
  EXPECT_NEAR(evaluation.all_m.p95, 0.013, kRoundingM);
  EXPECT_EQ(evaluation.off_surface.count, 0);
  EXPECT_FALSE(evaluation.people.has_value());
}

TEST(MapEvaluation, TellsSurfelsByTheirDistanceAtTheLastMeasurement) {
  const MapTruth truth = RoomTruth();
  SurfelCloud map;
  const Eigen::Vector3f n = -Eigen::Vector3f::UnitX();
  AddSurfel({1.9F, 0, 0}, n, map);                             // 1.9 m away, 100 mm off
  AddSurfel({2.04F, -0.1F, 0}, n, map, kRoomStartNs);          // 40 mm off
  AddSurfel({2.02F, 2, 1.9F}, n, map);                         // 3.5 m away, 20 mm off
  AddSurfel({2.5F, 3, 3}, n, map);                             // 5 m away
  AddSurfel({2, 0, 0}, n, map, kRoomStartNs - 1'000'000'000);  // when there was no pose
  AddSurfel({0, 0, 0}, n, map);
  map.confidence.back() = 9;
  const MapEvaluation evaluation = EvaluateMap(map, truth.trajectory, truth);
  EXPECT_EQ(evaluation.num_surfels, 6);
  EXPECT_EQ(evaluation.num_stable, 5);
  EXPECT_EQ(evaluation.num_unknown_distance, 1);
  EXPECT_EQ(evaluation.near_m.count, 2);
  EXPECT_NEAR(evaluation.near_m.mean, 0.07, kRoundingM);
  EXPECT_EQ(evaluation.far_m.count, 3);
  EXPECT_NEAR(evaluation.far_m.median, 0.04, kRoundingM);
}

TEST(MapEvaluation, FiguresStayWhenMapAndPosesMoveTogether) {
  MapTruth truth = RoomTruth();
  SurfelCloud map = WallMap(0.01F, -0.5F, 0.5F);
  for (int i = 0; i < 50; ++i) {
    AddSurfel({1, 0.02F * static_cast<float>(i), 0}, Eigen::Vector3f::UnitX(), map);
  }
  truth.people = {{kRoomStartNs, {{0, 0, {1, 0, -1}, {1, 0, 1}, 0.2F}}}};
  const MapEvaluation still = EvaluateMap(map, truth.trajectory, truth);
  EXPECT_EQ(still.people.value().count, 13);
  Vector6d twist;
  twist << 1, -2, 0.5, 0.4, -0.8, 2.1;
  MoveMap(ExpSE3(twist), map);
  const MapEvaluation moved = EvaluateMap(map, InOtherMap(truth.trajectory, ExpSE3(twist)), truth);
  EXPECT_TRUE(moved.T_truth_map.isApprox(ExpSE3(twist).inverse(), 1e-9));
  EXPECT_NEAR(moved.near_m.mean, still.near_m.mean, kRoundingM);
  EXPECT_NEAR(moved.near_m.p95, still.near_m.p95, kRoundingM);
  EXPECT_NEAR(moved.Completeness(), still.Completeness(), 0.001);
  EXPECT_EQ(moved.off_surface.count, still.off_surface.count);
  EXPECT_NEAR(moved.off_surface.area_cm2, still.off_surface.area_cm2, 0.01);
  EXPECT_EQ(moved.people.value().count, 13);
}

// Positions alone would turn the map here: the camera goes along a line.
TEST(MapEvaluation, MillimetresOfPoseErrorDoNotTurnTheMap) {
  MapTruth truth = RoomTruth();
  Trajectory estimate = truth.trajectory;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_map_camera.translation().z() += i % 2 == 0 ? 0.001 : -0.001;
    estimate[i].T_map_camera.translation().x() += i % 3 == 0 ? 0.001 : -0.0005;
  }
  const MapEvaluation evaluation = EvaluateMap(WallMap(0, -1, 1), estimate, truth);
  EXPECT_LT(evaluation.all_m.p95, 0.002);
}

TEST(MapEvaluation, CompletenessIsTheShareOfTheSeenWall) {
  const MapTruth truth = RoomTruth();
  const CameraModel& camera = truth.camera;
  const double width_m =
      double{kRoomHalfM} * camera.width / camera.fx + 0.2;  // 20 cm by the motion
  const double height_m = double{kRoomHalfM} * camera.height / camera.fy;
  const MapEvaluation whole = EvaluateMap(WallMap(0.01F), truth.trajectory, truth);
  EXPECT_NEAR(whole.seen_m2, width_m * height_m, kSamplingError * width_m * height_m);
  EXPECT_EQ(whole.Completeness(), 1);
  const MapEvaluation half = EvaluateMap(WallMap(0, 0, 2), truth.trajectory, truth);
  EXPECT_NEAR(half.Completeness(), 0.5, kSamplingError);
  const MapEvaluation off = EvaluateMap(WallMap(0.021F), truth.trajectory, truth);
  EXPECT_EQ(off.Completeness(), 0);
}

TEST(MapEvaluation, WhatABoxHidesNeedNotBeInTheMap) {
  MapTruth truth = RoomTruth();
  const double open_m2 = EvaluateMap({}, truth.trajectory, truth).seen_m2;
  AddRectangle({1, -2, -2}, {0, 4, 0}, {0, 0, 4}, truth.world);  // a screen before the whole wall
  const MapEvaluation screened = EvaluateMap({}, truth.trajectory, truth);
  // The screen is seen in half the distance: a quarter of the area, and 20 cm by the motion.
  const double height_m = 1 * truth.camera.height / truth.camera.fy;
  const double width_m = 1 * truth.camera.width / truth.camera.fx + 0.2;
  EXPECT_NEAR(screened.seen_m2, width_m * height_m, kSamplingError * width_m * height_m);
  EXPECT_LT(screened.seen_m2, open_m2);
}

TEST(MapEvaluation, GhostsHaveTheAreaOfTheirDiscs) {
  MapTruth truth = RoomTruth();
  SurfelCloud map = WallMap(0, -0.1F, 0.1F);
  const int num_wall = static_cast<int>(map.size());
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  AddSurfel({0.5F, 0, 0}, up, map, kRoomStartNs, 0.02F);
  AddSurfel({0.5F, 0, 0.001F}, up, map, kRoomStartNs, 0.02F);              // the same once more
  AddSurfel({0.5F, 1, 0}, up, map, kRoomStartNs, 0.03F);                   // nobody was there
  AddSurfel({0.5F, 0, 0.5F}, up, map, kRoomStartNs + 400'000'000, 0.01F);  // nobody any longer
  truth.people = {{kRoomStartNs, {{0, 0, {0.5F, 0, -1}, {0.5F, 0, 1}, 0.1F}}}};
  const MapEvaluation evaluation = EvaluateMap(map, truth.trajectory, truth);
  EXPECT_EQ(evaluation.off_surface.count, 4);
  EXPECT_NEAR(evaluation.off_surface.share, 4.0 / (num_wall + 4), 1e-9);
  EXPECT_NEAR(evaluation.off_surface.area_cm2, M_PI * (4 + 9 + 1), 0.2);
  EXPECT_EQ(evaluation.people.value().count, 2);
  EXPECT_NEAR(evaluation.people.value().area_cm2, M_PI * 4, 0.1);
}

TEST(MapEvaluation, AMovedThingIsASurfaceWhereAndWhileItStands) {
  MapTruth truth = RoomTruth();
  MovedSurfaces screen{"screen", kRoomStartNs + 200'000'000, kRoomStartNs + 400'000'000, {}, {},
                       {}};
  AddRectangle({1, -1, -1}, {0, 1, 0}, {0, 0, 1}, screen.before);
  AddRectangle({1, 0, -1}, {0, 1, 0}, {0, 0, 1}, screen.after);
  const Eigen::Vector3f n = -Eigen::Vector3f::UnitX();
  const Eigen::Vector3f first(1.01F, -0.5F, -0.5F);
  const Eigen::Vector3f second(1.01F, 0.5F, -0.5F);
  SurfelCloud map;
  for (const StampNs after_ns : {0, 300'000'000, 500'000'000}) {
    AddSurfel(first, n, map, kRoomStartNs + after_ns);
    AddSurfel(second, n, map, kRoomStartNs + after_ns);
  }
  EXPECT_EQ(EvaluateMap(map, truth.trajectory, truth).off_surface.count, 6);
  truth.moved = {screen};
  EXPECT_EQ(EvaluateMap(map, truth.trajectory, truth).off_surface.count, 4);
  truth.moved.front().after = screen.before;  // it comes back: only the moment of the move is left
  EXPECT_EQ(EvaluateMap(map, truth.trajectory, truth).off_surface.count, 4);
}

TEST(MapEvaluation, MovedThingsNeedNotBeInTheMap) {
  MapTruth truth = RoomTruth();
  const double before_m2 = EvaluateMap({}, truth.trajectory, truth).seen_m2;
  truth.moved.push_back({"screen", kRoomStartNs, kRoomStartNs, {}, {}, {}});
  AddRectangle({1, -1, -1}, {0, 2, 0}, {0, 0, 2}, truth.moved.back().before);
  EXPECT_EQ(EvaluateMap({}, truth.trajectory, truth).seen_m2, before_m2);
}

TEST(MapEvaluation, EmptyMapHasNoErrorsAndNothingInIt) {
  const MapTruth truth = RoomTruth();
  const MapEvaluation evaluation = EvaluateMap({}, truth.trajectory, truth);
  EXPECT_EQ(evaluation.all_m.count, 0);
  EXPECT_EQ(evaluation.off_surface.share, 0);
  EXPECT_EQ(evaluation.Completeness(), 0);
  EXPECT_GT(evaluation.seen_m2, 1);
}

TEST(MapEvaluation, SameFiguresForAnyNumberOfThreads) {
  const MapTruth truth = RoomTruth();
  const SurfelCloud map = WallMap(0.01F, -0.5F, 0.5F);
  MapEvaluationConfig config;
  config.num_threads = 1;
  const MapEvaluation one = EvaluateMap(map, truth.trajectory, truth, config);
  config.num_threads = 2;
  const MapEvaluation two = EvaluateMap(map, truth.trajectory, truth, config);
  EXPECT_EQ(one.all_m.mean, two.all_m.mean);
  EXPECT_EQ(one.seen_m2, two.seen_m2);
  EXPECT_EQ(one.covered_m2, two.covered_m2);
}

TEST(MapEvaluation, RefusesSettingsOutOfRange) {
  const MapTruth truth = RoomTruth();
  MapEvaluationConfig config;
  config.samples_per_m2 = 0;
  EXPECT_THROW(EvaluateMap({}, truth.trajectory, truth, config), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
