#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <memory>

#include "posefusion_ros/topic_names.h"
#include "test/ros/log_lines.h"
#include "test/ros/recorder.h"
#include "test/ros/robot_rig.h"

namespace posefusion {
namespace {

using testing::HasSubstr;

constexpr double kSubtractionTolerance = 1e-6;
/// tf of a robot lags behind its clock; a consumer that asks for now allows for that.
const ros::Duration kConsumerTimeout(0.3);

Eigen::Isometry3d ToIsometry(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d T(Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z));
  const auto& q = pose.orientation;
  T.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  return T;
}

Eigen::Isometry3d ToIsometry(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.position.z = transform.translation.z;
  pose.orientation = transform.rotation;
  return ToIsometry(pose);
}

/// What Mapping has said about that frame.
std::vector<geometry_msgs::TransformStamped> TransformsOf(const Recorder<tf2_msgs::TFMessage>& tf,
                                                          const std::string& child) {
  std::vector<geometry_msgs::TransformStamped> found;
  for (const auto& message : tf.messages()) {
    for (const auto& transform : message->transforms) {
      if (transform.child_frame_id == child) found.push_back(transform);
    }
  }
  return found;
}

class RobotTest : public testing::Test {
 protected:
  void Start(const std::string& odom = "odom") {
    graph_.SetParam("/blur_filter/enabled", false);
    graph_.SetParam("/mapping/frames/odom_frame", odom);
    graph_.SetParam("/mapping/ros/start/wait_s", 0.5);
    ASSERT_TRUE(graph_.Start());
    rig_ = std::make_unique<RobotRig>(graph_);
    ros::WallDuration(0.7).sleep();  // tf comes over a socket, which takes a moment to connect
  }

  bool HasTrouble(const std::string& text) {
    return graph_.WaitFor(
        [&](const Status& status) { return status.tf_trouble.find(text) != std::string::npos; });
  }

  NodeletGraph graph_;
  std::unique_ptr<RobotRig> rig_;
  Recorder<tf2_msgs::TFMessage> tf_{"/tf"};
  Recorder<geometry_msgs::PoseWithCovarianceStamped> head_{kHeadPoseTopic};

  /// The correction that belongs to a pose of the camera.
  Eigen::Isometry3d CorrectionOf(const geometry_msgs::PoseWithCovarianceStamped& pose) {
    const auto T_odom_camera = rig_->tree().Find("odom", kCameraLink, ToStampNs(pose.header.stamp));
    EXPECT_TRUE(T_odom_camera);
    return ToIsometry(pose.pose.pose) * T_odom_camera->inverse();
  }
};

TEST_F(RobotTest, CorrectionTimesOdometryIsThePoseAtTheImageStamp) {
  Start();
  rig_->SendImages(2);
  ros::WallDuration(0.3).sleep();
  const auto corrections = TransformsOf(tf_, "odom");
  ASSERT_GT(head_.size(), 20U);
  ASSERT_GT(corrections.size(), 40U) << "30 per second";
  std::vector<Eigen::Isometry3d> expected;
  for (const auto& pose : head_.messages()) expected.push_back(CorrectionOf(*pose));
  for (const auto& correction : corrections) {
    const Eigen::Isometry3d T = ToIsometry(correction.transform);
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const Eigen::Isometry3d& E) {
      return (T.matrix() - E.matrix()).norm() < kSubtractionTolerance;
    }));
  }
  EXPECT_LT((ToIsometry(corrections.back().transform).matrix() - expected.back().matrix()).norm(),
            kSubtractionTolerance);
  for (std::size_t i = 1; i < corrections.size(); ++i) {
    EXPECT_GT(corrections[i].header.stamp, corrections[i - 1].header.stamp) << "none repeats";
  }
  EXPECT_EQ(graph_.status().tf_trouble, "");
}

TEST_F(RobotTest, MapStartsWhereOdometryIsAndUpright) {
  Start();
  rig_->SendImages(0.3);
  ASSERT_TRUE(head_.WaitForSize(1));
  EXPECT_LT((CorrectionOf(*head_.messages()[0]).matrix() - Eigen::Matrix4d::Identity()).norm(),
            kSubtractionTolerance);
}

TEST_F(RobotTest, AConsumerThatAsksForNowGetsAnAnswerEachTimeEvenWhileLost) {
  Start();
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  double seconds = 8;
  ros::param::get("~consumer_seconds", seconds);
  std::thread camera([&] {
    rig_->SendImages(seconds / 2);
    rig_->send_depth = false;
    rig_->SendImages(1);
    rig_->send_depth = true;
    rig_->SendImages(seconds / 2);
  });
  EXPECT_TRUE(head_.WaitForSize(1));
  ros::WallDuration(0.2).sleep();  // the consumer hears of it a moment later
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  int answers = 0;
  std::vector<std::string> failures;
  while (ros::WallTime::now() < end) {
    try {
      buffer.lookupTransform("map", kCameraLink, ros::Time::now(), kConsumerTimeout);
      ++answers;
    } catch (const tf2::TransformException& error) {
      failures.emplace_back(error.what());
    }
    ros::WallDuration(0.02).sleep();
  }
  camera.join();
  EXPECT_THAT(failures, testing::IsEmpty());
  EXPECT_GT(answers, 10 * seconds);
  EXPECT_GT(graph_.status().frames_lost, 0U);
}

TEST_F(RobotTest, LateOdometryIsUsedAtTheImageStampAllTheSame) {
  Start();
  rig_->tf_delay_s = 0.1;
  rig_->SendImages(1.5);
  ros::WallDuration(0.4).sleep();
  ASSERT_GT(head_.size(), 15U);
  const auto corrections = TransformsOf(tf_, "odom");
  ASSERT_FALSE(corrections.empty());
  EXPECT_LT((ToIsometry(corrections.back().transform).matrix() -
             CorrectionOf(*head_.messages().back()).matrix())
                .norm(),
            kSubtractionTolerance);
  EXPECT_EQ(graph_.status().tf_trouble, "");
}

TEST_F(RobotTest, MissingOdometryIsToldAndTrackingGoesOnUntilItComes) {
  Start();
  rig_->send_tf = false;
  ros::WallDuration(0.3).sleep();
  rig_->SendImages(1.5);
  EXPECT_TRUE(HasTrouble("no transform from odom"));
  EXPECT_GT(graph_.status().frames_tracked, 5U);
  EXPECT_EQ(TransformsOf(tf_, "odom").size(), 0U);
  rig_->send_tf = true;
  rig_->SendImages(1);
  EXPECT_GT(TransformsOf(tf_, "odom").size(), 10U);
  EXPECT_EQ(graph_.status().tf_trouble, "");
}

TEST_F(RobotTest, AFrameOfAnotherPublisherIsLeftToIt) {
  Start("rival_odom");
  rig_->SendImages(0.5);
  EXPECT_TRUE(HasTrouble("rival_odom has the parent map already (published by /rival)"));
  EXPECT_EQ(TransformsOf(tf_, "rival_odom").size(), 0U);
  EXPECT_GT(head_.size(), 0U);
}

TEST_F(RobotTest, ALoopInTfIsToldAndTrackingGoesOn) {
  Start();
  rig_->SendImages(0.5);
  ASSERT_TRUE(head_.WaitForSize(1));
  tf2_msgs::TFMessage loop;
  loop.transforms = {MakeTransform(kCameraLink, "odom", ToStampNs(ros::Time::now()),
                                   Eigen::Isometry3d::Identity())};
  auto publisher = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 10, true);
  publisher.publish(loop);
  const std::size_t poses_before = head_.size();
  rig_->SendImages(0.7);
  EXPECT_TRUE(HasTrouble(std::string("odom has the parent ") + kCameraLink + " already"));
  EXPECT_GT(head_.size(), poses_before + 5);
  const std::size_t sent = TransformsOf(tf_, "odom").size();
  rig_->SendImages(0.5);
  EXPECT_EQ(TransformsOf(tf_, "odom").size(), sent) << "nothing makes it worse";
}

TEST_F(RobotTest, OdometryThatJumpsIsToldAndTheCorrectionFollows) {
  Start();
  const LogLines log;
  rig_->SendImages(1);
  const auto tracked = graph_.status().frames_tracked;
  rig_->odometry_offset_m = 2;
  rig_->SendImages(1.5);
  ros::WallDuration(0.3).sleep();
  const std::size_t told = log.Count({"odom jumped by"}) - log.Count({"the last: odom jumped by"});
  EXPECT_GE(told, 1U);
  EXPECT_LE(told, 2U) << "an image may have been taken on the way";
  EXPECT_EQ(graph_.status().frames_lost, 0U);
  EXPECT_GT(graph_.status().frames_tracked, tracked + 10);
  EXPECT_EQ(graph_.status().tf_trouble, "");
  EXPECT_LT((ToIsometry(TransformsOf(tf_, "odom").back().transform).matrix() -
             CorrectionOf(*head_.messages().back()).matrix())
                .norm(),
            kSubtractionTolerance);
}

TEST_F(RobotTest, TimeThatJumpsBackResetsOnceAndTheNewRunIsLocated) {
  Start();
  rig_->SendImages(0.7);
  rig_->clock_offset_s = -100;
  ros::WallDuration(0.2).sleep();
  rig_->SendImages(0.7);
  ASSERT_TRUE(graph_.WaitFor([](const Status& status) { return status.resets == 1; }));
  ros::WallDuration(0.3).sleep();
  EXPECT_EQ(graph_.status().resets, 1U);
  EXPECT_GT(graph_.status().frames_tracked, 5U);
  EXPECT_EQ(graph_.status().tf_trouble, "");
  EXPECT_LT(head_.messages().back()->header.stamp.toSec(), ros::Time::now().toSec() - 90);
  EXPECT_LT((ToIsometry(TransformsOf(tf_, "odom").back().transform).matrix() -
             CorrectionOf(*head_.messages().back()).matrix())
                .norm(),
            kSubtractionTolerance);
}

TEST_F(RobotTest, HeadPoseAndOdometryAreOfTheFramesAskedFor) {
  graph_.SetParam("/mapping/frames/head_frame", std::string("NECK_P_LINK"));
  graph_.SetParam("/mapping/frames/base_frame", std::string(kRootLink));
  const Recorder<nav_msgs::Odometry> odometry(kOdometryTopic);
  Start();
  rig_->SendImages(1);
  ASSERT_TRUE(head_.WaitForSize(3) && odometry.WaitForSize(3));
  const auto& moved = *odometry.messages()[2];
  EXPECT_EQ(moved.child_frame_id, kRootLink);
  EXPECT_EQ(moved.header.frame_id, "visual_odom");
  // The distance of head and base does not depend on the map.
  const StampNs stamp = ToStampNs(moved.header.stamp);
  const auto T_base_head = rig_->tree().Find(kRootLink, "NECK_P_LINK", stamp);
  const auto head = head_.messages()[2];
  ASSERT_EQ(head->header.stamp, moved.header.stamp);
  const Eigen::Isometry3d T_between =
      ToIsometry(moved.pose.pose).inverse() * ToIsometry(head->pose.pose);
  EXPECT_LT((T_between.matrix() - T_base_head->matrix()).norm(), 1e-6);
  EXPECT_GT(moved.pose.covariance[0], 0);
  // What is uncertain in the turn is so in the place of the base, too, but the turn is one.
  const auto sum = [](const auto& covariance, std::size_t i) {
    return covariance[i] + covariance[i + 7] + covariance[i + 14];
  };
  EXPECT_NE(sum(moved.pose.covariance, 0), sum(head->pose.covariance, 0));
  EXPECT_NEAR(sum(moved.pose.covariance, 21), sum(head->pose.covariance, 21), 1e-12);
}

TEST(Urdf, IsTheChainOfTheSimulator) {
  ros::NodeHandle node;
  tf2::BufferCore buffer;
  const auto add = [&](const tf2_msgs::TFMessageConstPtr& message) {
    for (const auto& transform : message->transforms) {
      buffer.setTransform(transform, "urdf", transform.child_frame_id == kCameraLink);
    }
  };
  const auto moving = node.subscribe<tf2_msgs::TFMessage>("/urdf_tf", 100, add);
  const auto fixed = node.subscribe<tf2_msgs::TFMessage>(
      "/urdf_tf_static", 100, [&](const tf2_msgs::TFMessageConstPtr& message) {
        for (const auto& t : message->transforms) buffer.setTransform(t, "urdf", true);
      });
  auto publisher = node.advertise<sensor_msgs::JointState>("/joint_states", 10);
  const NeckAngles neck = {0.4, 0.25};
  sensor_msgs::JointState state;
  state.name = JointNames();
  state.position = JointAngles(neck);
  bool found = false;
  for (int i = 0; i < 100 && !found; ++i) {
    state.header.stamp = ros::Time::now();
    publisher.publish(state);
    ros::WallDuration(0.05).sleep();
    found = buffer.canTransform(kRootLink, kCameraLink, ros::Time(0));
  }
  ASSERT_TRUE(found);
  const Eigen::Isometry3d T =
      ToIsometry(buffer.lookupTransform(kRootLink, kCameraLink, ros::Time(0)).transform);
  EXPECT_LT((T.matrix() - T_body_camera(neck).matrix()).norm(), 1e-6);
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  ros::init(argc, argv, "robot_test");
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
