#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "posefusion_ros/topic_names.h"
#include "test/ros/log_lines.h"
#include "test/ros/nodelet_graph.h"
#include "test/ros/recorder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;

constexpr StampNs kSecondNs = 1'000'000'000;

/// Mapping alone sees what BlurFilter would keep from it.
class BadInput : public testing::Test {
 protected:
  BadInput() {
    graph_.SetParam("/blur_filter/enabled", false);
    EXPECT_TRUE(graph_.Start());
  }

  RgbdMessages Good() { return PairedMessages(next_index_++); }

  /// Publishes and waits until Mapping has refused it.
  void ExpectRefused(const RgbdMessages& frame, const std::string& why) {
    const Status before = graph_.status();
    graph_.Publish(frame);
    EXPECT_TRUE(graph_.WaitFor([&](const Status& status) {
      return status.frames_refused > before.frames_refused;
    })) << why;
    EXPECT_THAT(graph_.status().detail, HasSubstr(why));
    EXPECT_EQ(graph_.status().frames_processed, before.frames_processed);
  }

  void ExpectTracked(const RgbdMessages& frame) {
    const auto before = graph_.status().frames_tracked;
    graph_.Publish(frame);
    EXPECT_TRUE(graph_.WaitFor([&](const Status& status) {
      return status.frames_tracked == before + 1;
    })) << graph_.status().state
        << ": " << graph_.status().detail;
    EXPECT_EQ(graph_.status().state, "tracking");
  }

  NodeletGraph graph_;
  int next_index_ = 0;
};

TEST_F(BadInput, UnusableImagesAreRefusedByNameAndGoodOnesGoOn) {
  ExpectTracked(Good());

  RgbdMessages unknown = Good();
  auto rgb = boost::make_shared<sensor_msgs::Image>(*unknown.rgb);
  rgb->encoding = "yuv422";
  unknown.rgb = rgb;
  ExpectRefused(unknown, "/sharp/rgb/image_rect_color: colour encoding 'yuv422'");
  ExpectTracked(Good());

  RgbdMessages other_size = Good();
  auto depth = boost::make_shared<sensor_msgs::Image>(*other_size.depth);
  depth->height /= 2;
  other_size.depth = depth;
  ExpectRefused(other_size, "/sharp/depth_registered/image_rect");
  ExpectTracked(Good());

  RgbdMessages uncalibrated = Good();
  auto info = boost::make_shared<sensor_msgs::CameraInfo>(*uncalibrated.info);
  info->K.fill(0);
  uncalibrated.info = info;
  ExpectRefused(uncalibrated, "/sharp/rgb/camera_info: the camera is not calibrated");
  ExpectTracked(Good());
}

TEST_F(BadInput, CameraInfoThatDoesNotFitTheImageIsRefused) {
  ExpectTracked(Good());
  RgbdMessages smaller = Good();
  auto info = boost::make_shared<sensor_msgs::CameraInfo>(*smaller.info);
  info->width /= 2;
  info->height /= 2;
  smaller.info = info;
  ExpectRefused(smaller, "/sharp/rgb/camera_info");
  ExpectTracked(Good());
}

TEST_F(BadInput, MissingCameraInfoIsToldAndRecoveredFrom) {
  for (int i = 0; i < 15; ++i) {
    RgbdMessages frame = Good();
    frame.info = nullptr;
    graph_.Publish(frame);
  }
  EXPECT_TRUE(graph_.WaitFor([](const Status& status) { return status.frames_refused > 0; }));
  EXPECT_THAT(graph_.status().detail, HasSubstr("/sharp/rgb/camera_info: no camera_info has come"));
  EXPECT_EQ(graph_.status().state, "waiting");
  graph_.Publish(Good());
  EXPECT_TRUE(graph_.WaitForProcessed(1));
}

TEST_F(BadInput, NoPoseIsPublishedWhileLost) {
  const Recorder<geometry_msgs::PoseWithCovarianceStamped> pose(kHeadPoseTopic);
  const Recorder<tf2_msgs::TFMessage> tf("/tf");
  ros::WallDuration(0.5).sleep();
  ExpectTracked(Good());
  ASSERT_TRUE(pose.WaitForSize(1) && tf.WaitForSize(1));

  RgbdMessages no_depth = Good();
  auto depth = boost::make_shared<sensor_msgs::Image>(*no_depth.depth);
  std::fill(depth->data.begin(), depth->data.end(), 0);
  no_depth.depth = depth;
  graph_.Publish(no_depth);
  EXPECT_TRUE(graph_.WaitFor([](const Status& status) { return status.state == "lost"; }));
  EXPECT_EQ(graph_.status().frames_lost, 1U);
  EXPECT_EQ(graph_.status().times_lost, 1U);
  EXPECT_NE(graph_.status().detail, "");

  ExpectTracked(Good());
  ASSERT_TRUE(pose.WaitForSize(2) && tf.WaitForSize(2));
  EXPECT_EQ(pose.size(), 2U);
  EXPECT_EQ(tf.size(), 2U);
}

TEST_F(BadInput, RestartedBagResetsOnceAndSaysSo) {
  const LogLines log;
  for (int i = 0; i < 3; ++i) ExpectTracked(PairedMessages(i));
  for (int i = 0; i < 3; ++i) {
    graph_.Publish(PairedMessages(i, kSyntheticStartNs - 100 * kSecondNs));
    EXPECT_TRUE(graph_.WaitFor([&](const Status& status) {
      return status.resets == 1 && status.frames_processed == static_cast<std::uint64_t>(i + 1);
    }));
  }
  EXPECT_EQ(graph_.status().frames_tracked, 3U);
  EXPECT_TRUE(log.WaitFor({"map and poses start anew"}, 5));
  EXPECT_EQ(log.Count({"map and poses start anew"}), 1U);
}

}  // namespace
}  // namespace posefusion
