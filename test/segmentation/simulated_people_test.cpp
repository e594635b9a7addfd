// People of the simulator, keypoints with the faults of a pose network.

#include <gtest/gtest.h>

#include "posefusion/evaluation/mask_evaluation.h"
#include "posefusion/segmentation/person_cutter.h"
#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/simulator.h"

namespace posefusion {
namespace {

constexpr int kNumFrames = 4;

TEST(SimulatedPeople, AreCutOutNearlyWhole) {
  SimulationConfig config;
  config.preset = "fr3_xyz";
  config.seconds = 1;
  Simulator simulator(CheckedConfig(config), 2);
  PersonCutter cutter{HumanRemovalConfig()};
  MaskCounts pooled;
  for (int i = 0; i < kNumFrames; ++i) {
    const auto frame = simulator.Next();
    ASSERT_TRUE(frame);
    Skeletons skeletons;
    skeletons.people = DetectKeypoints(*frame, simulator)->people;
    cv::Mat mask;
    cutter.Cut(frame->frame, skeletons, mask);
    cv::Mat truth = frame->labels.clone();
    truth.setTo(0, truth < kLabelPerson);
    pooled = pooled + ScoreMask(truth, mask, frame->frame.depth_m, &skeletons.people, {}).counts;
  }
  EXPECT_GT(pooled.person_found, 10000);
  EXPECT_GT(pooled.Recall(), 0.93);
  EXPECT_GT(pooled.Precision(), 0.85);
}

}  // namespace
}  // namespace posefusion
