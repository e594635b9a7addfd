#include "posefusion/simulation/sim_keypoints.h"

#include <gtest/gtest.h>

#include <memory>

#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/simulation/folder_writer.h"
#include "posefusion/simulation/sim_source.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "test/skeleton/sample_skeletons.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

constexpr StampNs kEnd = kSimulationStartNs + 1'000'000'000'000;

SimulationConfig LateKeypoints() {
  SimulationConfig config;
  config.preset = "fr3_static";
  config.humans = 2;
  config.seconds = 0.5;
  config.keypoint_timing.rate_hz = 15;
  config.keypoint_timing.latency_s = 0.1;
  return config;
}

/// Everything that a source gives out, frame by frame.
std::vector<Skeletons> AllOf(FrameSource& frames, SkeletonSource& keypoints) {
  std::vector<Skeletons> all;
  const auto add = [&](StampNs now_ns) {
    for (const Skeletons& skeletons : keypoints.Take(now_ns)) all.push_back(skeletons);
  };
  while (const auto frame = frames.Next()) {
    keypoints.Offer(*frame);
    add(frame->stamp_ns);
  }
  add(kEnd);
  return all;
}

TEST(SimKeypoints, StreamEqualsFolderExactly) {
  const TemporaryFolder folder;
  Simulator simulator(LateKeypoints(), 2);
  FolderWriter writer(folder / "run", false);
  while (const auto frame = simulator.Next()) writer.Write(*frame, simulator);
  writer.Close(simulator);
  TumFolderSource written(folder / "run");
  SkeletonFolder files(folder / "run/keypoints");
  const auto from_folder = AllOf(written, files);

  auto source = std::make_unique<SimSource>(LateKeypoints(), 2);
  const auto mailed = source->MakeKeypoints();
  PrefetchedSource streamed(std::move(source));
  const auto from_stream = AllOf(streamed, *mailed);

  ASSERT_EQ(from_folder.size(), from_stream.size());
  EXPECT_GE(from_stream.size(), 7U);
  std::size_t num_people = 0;
  for (std::size_t i = 0; i < from_stream.size(); ++i) {
    EXPECT_EQ(from_folder[i].stamp_ns, from_stream[i].stamp_ns) << i;
    EXPECT_EQ(from_folder[i].arrival_ns, from_stream[i].arrival_ns) << i;
    EXPECT_EQ(testing::Numbers(from_folder[i].people), testing::Numbers(from_stream[i].people));
    num_people += from_stream[i].people.size();
  }
  EXPECT_GT(num_people, 0U);
  EXPECT_GT(from_stream[0].arrival_ns, from_stream[0].stamp_ns);
  EXPECT_EQ(files.counts().frames_with_keypoints, mailed->counts().frames_with_keypoints);
}

TEST(KeypointMailbox, ForgetsWhatIsPassedOver) {
  KeypointMailbox mailbox;
  for (const StampNs stamp_ns : {1, 2, 3}) {
    Skeletons skeletons;
    skeletons.stamp_ns = stamp_ns;
    mailbox.Put(skeletons);
  }
  EXPECT_TRUE(mailbox.Take(2));
  EXPECT_FALSE(mailbox.Take(2));
  EXPECT_FALSE(mailbox.Take(1));
  EXPECT_TRUE(mailbox.Take(3));
}

}  // namespace
}  // namespace posefusion
