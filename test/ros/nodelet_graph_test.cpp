#include "test/ros/nodelet_graph.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <posefusion/BlurScore.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/pipeline/offline_run.h"
#include "posefusion_ros/bag_source.h"
#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/recorder.h"
#include "test/ros/synthetic_room.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

sensor_msgs::ImagePtr Blurred(const sensor_msgs::Image& image) {
  const auto copy = boost::make_shared<sensor_msgs::Image>(image);
  cv::Mat pixels(static_cast<int>(copy->height), static_cast<int>(copy->width), CV_8UC3,
                 copy->data.data());
  cv::blur(pixels, pixels, cv::Size(31, 1));
  return copy;
}

/// The trajectory file that run_dataset makes of a bag, without any nodelet.
std::string DirectTrajectory(const std::string& bag, const TemporaryFolder& folder) {
  BagSource source(bag);
  const OfflineRun run = RunOffline(source, SystemConfig(), 1);
  WriteTrajectory(run.trajectory, folder / "direct.txt");
  return ReadWholeFile(folder / "direct.txt");
}

/// The one that Mapping saves when the bag has gone through the nodelets.
std::string GraphTrajectory(const std::string& bag, const TemporaryFolder& folder) {
  NodeletGraph graph;
  graph.SetParam("/blur_filter/ros/input/lossless", true);
  graph.SetParam("/blur_filter/ros/input/flush_after_s", 0.3);
  graph.SetParam("/mapping/ros/input/lossless", true);
  graph.SetParam("/mapping/ros/output_dir", folder / "out");
  EXPECT_TRUE(graph.Start());
  graph.PublishInBagOrder(bag);
  EXPECT_TRUE(graph.WaitFor([](const Status& status) { return status.state == "no_data"; }));
  EXPECT_EQ(graph.status().frames_dropped, 0U);
  EXPECT_EQ(graph.status().frames_refused, 0U);
  graph.Stop();
  return ReadWholeFile(folder / "out/trajectory.txt");
}

TEST(NodeletGraph, MappingGetsTheVerySameMessages) {
  NodeletGraph graph;
  ASSERT_TRUE(graph.Start());
  const Recorder<sensor_msgs::Image> rgb(kSharpRgbTopic);
  const Recorder<sensor_msgs::Image> depth(kSharpDepthTopic);
  const Recorder<sensor_msgs::CameraInfo> info(kSharpInfoTopic);
  std::vector<RgbdMessages> sent;
  for (int i = 0; i < 5; ++i) {
    sent.push_back(PairedMessages(i));
    graph.Publish(sent.back());
  }
  ASSERT_TRUE(rgb.WaitForSize(5) && depth.WaitForSize(5) && info.WaitForSize(5));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(rgb.messages()[i].get(), sent[i].rgb.get());
    EXPECT_EQ(depth.messages()[i].get(), sent[i].depth.get());
    EXPECT_EQ(info.messages()[i].get(), sent[i].info.get());
  }
}

TEST(NodeletGraph, BlurredFramesGoElsewhere) {
  NodeletGraph graph;
  ASSERT_TRUE(graph.Start());
  const Recorder<sensor_msgs::Image> blurred(kBlurredRgbTopic);
  const Recorder<sensor_msgs::Image> blurred_depth(kBlurredDepthTopic);
  const Recorder<sensor_msgs::CameraInfo> blurred_info(kBlurredInfoTopic);
  const Recorder<sensor_msgs::Image> rgb(kSharpRgbTopic);
  const Recorder<BlurScore> score(kBlurScoreTopic);
  constexpr std::size_t kBlurred = 7;
  RgbdMessages dropped;
  for (std::size_t i = 0; i < 10; ++i) {
    RgbdMessages frame = PairedMessages(static_cast<int>(i));
    if (i == kBlurred) frame.rgb = Blurred(*frame.rgb);
    if (i == kBlurred) dropped = frame;
    graph.Publish(frame);
  }
  ASSERT_TRUE(score.WaitForSize(10) && rgb.WaitForSize(9));
  EXPECT_EQ(score.messages()[kBlurred]->kept, 0);
  EXPECT_EQ(score.messages()[kBlurred]->reason, "blurred");
  EXPECT_EQ(score.messages()[9]->frames_dropped, 1U);
  EXPECT_EQ(rgb.size(), 9U);
  ASSERT_TRUE(blurred.WaitForSize(1) && blurred_depth.WaitForSize(1));
  ASSERT_TRUE(blurred_info.WaitForSize(1));
  EXPECT_EQ(blurred.messages()[0].get(), dropped.rgb.get());
  EXPECT_EQ(blurred_depth.messages()[0].get(), dropped.depth.get());
  EXPECT_EQ(blurred_info.messages()[0].get(), dropped.info.get());
}

TEST(NodeletGraph, FedSlowlyGivesTheTrajectoryOfRunDataset) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "room.bag", "camera_rgb_optical_frame");
    for (int i = 0; i < 30; ++i) writer.Write(SyntheticFrame(i));
    writer.Close();
  }
  const std::string direct = DirectTrajectory(folder / "room.bag", folder);
  EXPECT_EQ(std::count(direct.begin(), direct.end(), '\n'), 31) << "30 poses and a comment";
  EXPECT_EQ(GraphTrajectory(folder / "room.bag", folder), direct);
}

TEST(NodeletGraph, FedSlowlyGivesTheTrajectoryOfRunDatasetOnRealData) {
  SKIP_WITHOUT_DATA("fr1_xyz");
  const TemporaryFolder folder;
  {
    TumFolderOptions options;
    options.max_frames = 40;
    TumFolderSource source(DataPath("fr1_xyz"), options);
    BagWriter writer(folder / "fr1.bag", "camera_rgb_optical_frame");
    while (const auto frame = source.Next()) writer.Write(*frame);
    writer.Close();
  }
  const std::string direct = DirectTrajectory(folder / "fr1.bag", folder);
  EXPECT_EQ(GraphTrajectory(folder / "fr1.bag", folder), direct);
}

TEST(NodeletGraph, PublishesPoseAndCloudAtTheImageStamp) {
  NodeletGraph graph;
  graph.SetParam("/mapping/frames/map_frame", "robot/map");
  ASSERT_TRUE(graph.Start());
  const Recorder<tf2_msgs::TFMessage> tf("/tf");
  const Recorder<geometry_msgs::PoseWithCovarianceStamped> pose(kHeadPoseTopic);
  const Recorder<sensor_msgs::PointCloud2> cloud(kSurfelCloudTopic);
  ros::WallDuration(0.5).sleep();  // tf comes over a socket, which takes a moment to connect
  const RgbdMessages frame = PairedMessages(0);
  graph.Publish(frame);
  ASSERT_TRUE(graph.WaitForProcessed(1));
  ASSERT_TRUE(pose.WaitForSize(1) && tf.WaitForSize(1) && cloud.WaitForSize(1));
  EXPECT_EQ(pose.messages()[0]->header.stamp, frame.rgb->header.stamp);
  EXPECT_EQ(pose.messages()[0]->header.frame_id, "robot/map");
  const auto& transform = tf.messages()[0]->transforms.at(0);
  EXPECT_EQ(transform.header.stamp, frame.rgb->header.stamp);
  EXPECT_EQ(transform.header.frame_id, "robot/map");
  EXPECT_EQ(transform.child_frame_id, frame.rgb->header.frame_id);
  EXPECT_EQ(cloud.messages()[0]->header.frame_id, "robot/map");
}

TEST(NodeletGraph, WrongParametersStopTheStart) {
  NodeletGraph unknown;
  unknown.SetParam("/mapping/ros/no_such_key", 1);
  EXPECT_FALSE(unknown.Start());
  unknown.Stop();
  unknown.SetParam("/blur_filter/threshold", -1.0);
  EXPECT_FALSE(unknown.Start());
  unknown.Stop();
  unknown.SetParam("/mapping/ros/output_dir", std::string("/proc/nowhere"));
  EXPECT_FALSE(unknown.Start());
}

TEST(NodeletGraph, BusyMappingDropsTheOldestAndCounts) {
  NodeletGraph graph;
  graph.SetParam("/blur_filter/enabled", false);
  graph.SetParam("/mapping/ros/queue_size", 1);
  ASSERT_TRUE(graph.Start());
  constexpr std::uint64_t kNumFrames = 60;
  std::vector<RgbdMessages> frames;
  for (std::uint64_t i = 0; i < kNumFrames; ++i)
    frames.push_back(PairedMessages(static_cast<int>(i)));
  for (const auto& frame : frames) {
    graph.Publish(frame);
    ros::WallDuration(0.0005).sleep();
  }
  EXPECT_TRUE(graph.WaitFor([](const Status& status) { return status.state == "no_data"; }));
  EXPECT_GT(graph.status().frames_dropped, 0U);
  EXPECT_LE(graph.status().frames_processed + graph.status().frames_dropped, kNumFrames);
  EXPECT_EQ(graph.status().header.stamp, frames.back().rgb->header.stamp) << "the newest is kept";
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  ros::init(argc, argv, "nodelet_graph_test");
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
