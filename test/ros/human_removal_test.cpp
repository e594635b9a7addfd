// All nodelets with people in the pictures.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <posefusion/HumanInfo.h>
#include <ros/xmlrpc_manager.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/common/atomic_file.h"
#include "posefusion/common/stamp.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/pipeline/offline_run.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "posefusion_ros/bag_odometry.h"
#include "posefusion_ros/bag_source.h"
#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/log_lines.h"
#include "test/ros/nodelet_graph.h"
#include "test/ros/person_scene.h"
#include "test/ros/recorder.h"
#include "test/ros/robot_tf.h"
#include "test/skeleton/sample_skeletons.h"
#include "test/support/rendered_source.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

/// Long enough for a busy computer.
constexpr double kPatientGraceS = 2;
constexpr int kNumFrames = 30;
constexpr int kBlurredFrame = 17;
constexpr char kCameraFrame[] = "camera_rgb_optical_frame";
/// tf of an image comes after it.
const ros::Duration kTfDelay(0.02);

using Masks = std::map<StampNs, cv::Mat>;

/// The pose of the camera when the image was taken, but for a roll: masks without gravity differ.
void WritePose(int index, StampNs stamp_ns, BagWriter& writer) {
  const Eigen::Isometry3d T_odom_camera = posefusion::testing::SwayingPose(index) *
                                          Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  tf2_msgs::TFMessage message;
  message.transforms = {MakeTransform("odom", kCameraFrame, stamp_ns, T_odom_camera)};
  writer.WriteOther(
      [&](rosbag::Bag& bag) { bag.write(kTfTopic, ToRosTime(stamp_ns) + kTfDelay, message); });
}

/// A bag of somebody walking, with tf and keypoint files for every frame. One image is blurred.
void WriteRun(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder / "keypoints");
  BagWriter writer(folder / "person.bag", kCameraFrame);
  for (int i = 0; i < kNumFrames; ++i) {
    PersonFrame person = SyntheticPerson(i);
    if (i == kBlurredFrame) cv::blur(person.frame.rgb, person.frame.rgb, cv::Size(31, 1));
    writer.Write(person.frame);
    WritePose(i, person.frame.stamp_ns, writer);
    const std::string name = FormatStamp(person.frame.stamp_ns) + ".json";
    posefusion::testing::WritePeople(folder / ("keypoints/" + name), person.skeletons.people);
  }
  writer.Close();
}

/// What run_dataset makes of it. Returns the trajectory file.
std::string RunDirectly(const TemporaryFolder& folder, Masks& masks,
                        const SystemConfig& config = SystemConfig(),
                        const OdometrySource* odometry = nullptr) {
  BagSource source(folder / "person.bag");
  SkeletonFolder skeletons(folder / "keypoints");
  OfflineRunHooks hooks;
  hooks.on_mask = [&](StampNs stamp_ns, const cv::Mat& mask) { masks[stamp_ns] = mask; };
  const OfflineRun run = RunOffline(source, config, 1, hooks, &skeletons, odometry);
  WriteTrajectory(run.trajectory, folder / "direct.txt");
  return ReadWholeFile(folder / "direct.txt");
}

/// The same through the nodelets, of which `graph` may have parameters.
std::string RunThroughGraph(const TemporaryFolder& folder, Masks& masks, NodeletGraph& graph) {
  const Recorder<sensor_msgs::Image> recorder(kStaticMaskTopic);
  graph.SetParam("/blur_filter/ros/input/lossless", true);
  graph.SetParam("/blur_filter/ros/input/flush_after_s", 0.3);
  graph.SetParam("/skeleton_ingest/lossless", true);
  graph.SetParam("/skeleton_ingest/source", std::string("folder"));
  graph.SetParam("/skeleton_ingest/folder", folder / "keypoints");
  graph.SetParam("/human_removal/ros/input/lossless", true);
  graph.SetParam("/human_removal/ros/keypoint_grace_s", kPatientGraceS);
  graph.SetParam("/mapping/ros/human_removal", true);
  graph.SetParam("/mapping/ros/input/lossless", true);
  graph.SetParam("/mapping/ros/output_dir", folder / "out");
  EXPECT_TRUE(graph.Start());
  graph.PublishInBagOrder(folder / "person.bag");
  EXPECT_TRUE(graph.WaitFor([](const Status& status) { return status.state == "no_data"; }));
  const Status status = graph.status();
  EXPECT_EQ(status.frames_dropped + status.frames_refused + status.frames_evicted, 0U);
  EXPECT_EQ(status.people, 1);
  EXPECT_EQ(status.mask_age_s, 0);
  graph.Stop();
  for (const auto& message : recorder.messages()) {
    masks[ToStampNs(message->header.stamp)] = ToMask(message, kStaticMaskTopic);
  }
  return ReadWholeFile(folder / "out/trajectory.txt");
}

void ExpectEqual(const Masks& expected, const Masks& masks) {
  ASSERT_EQ(masks.size(), expected.size());
  EXPECT_EQ(masks.size(), kNumFrames - 1U);
  EXPECT_EQ(masks.count(SyntheticPerson(kBlurredFrame).frame.stamp_ns), 0U);
  for (const auto& [stamp_ns, mask] : expected) {
    ASSERT_EQ(masks.count(stamp_ns), 1U);
    EXPECT_GT(cv::countNonZero(mask), 200) << "somebody is in every frame";
    EXPECT_EQ(cv::countNonZero(mask != masks.at(stamp_ns)), 0) << FormatStamp(stamp_ns);
  }
}

TEST(HumanRemoval, FedSlowlyGivesMasksAndTrajectoryOfRunDataset) {
  const TemporaryFolder folder;
  WriteRun(folder);
  Masks direct_masks;
  Masks masks;
  const std::string direct = RunDirectly(folder, direct_masks);
  NodeletGraph graph;
  EXPECT_EQ(RunThroughGraph(folder, masks, graph), direct);
  ExpectEqual(direct_masks, masks);
}

TEST(HumanRemoval, WithGravityOfTfGivesMasksOfRunDataset) {
  const TemporaryFolder folder;
  WriteRun(folder);
  SystemConfig config;
  config.human_removal.min_cut.penalty_distance = PenaltyDistance::kPlane;
  const BagOdometry odometry(folder / "person.bag", "odom", kCameraRgbTopic);
  Masks without;
  RunDirectly(folder, without, config);
  Masks direct_masks;
  RunDirectly(folder, direct_masks, config, &odometry);
  int num_different = 0;
  for (const auto& [stamp_ns, mask] : direct_masks) {
    num_different += cv::countNonZero(mask != without[stamp_ns]) > 0 ? 1 : 0;
  }
  EXPECT_GT(num_different, kNumFrames / 2) << "of those without gravity";
  NodeletGraph graph;
  graph.SetParam("/human_removal/min_cut/penalty_distance", std::string("plane"));
  graph.SetParam("/human_removal/frames/odom_frame", std::string("/odom"));
  graph.SetParam("/human_removal/ros/gravity_wait_s", kPatientGraceS);
  Masks masks;
  RunThroughGraph(folder, masks, graph);
  ExpectEqual(direct_masks, masks);
}

/// The nodelets without BlurFilter's doing, keypoints sent by the test.
class HumanRemovalGraph : public ::testing::Test {
 protected:
  HumanRemovalGraph() : skeletons_(node_.advertise<SkeletonsMessage>(kSkeletonsTopic, 100)) {
    graph_.SetParam("/blur_filter/enabled", false);
    graph_.SetParam("/mapping/ros/human_removal", true);
  }

  void Start() {
    ASSERT_TRUE(graph_.Start());
    while (ros::ok() && skeletons_.getNumSubscribers() == 0) ros::WallDuration(0.005).sleep();
  }

  void PublishKeypoints(const PersonFrame& person) {
    skeletons_.publish(MessageOf(person.skeletons));
  }
  static SkeletonsMessage MessageOf(const Skeletons& skeletons) {
    std_msgs::Header header;
    header.stamp = ToRosTime(skeletons.stamp_ns);
    return ToSkeletonsMessage(skeletons, header);
  }

  /// Publishes the frame and waits until Mapping has worked on it.
  HumanInfo Process(const PersonFrame& person) {
    const std::size_t before = infos_.size();
    graph_.Publish(Paired(person.frame));
    EXPECT_TRUE(infos_.WaitForSize(before + 1));
    EXPECT_TRUE(graph_.WaitFor([&](const Status& status) {
      return status.header.stamp == ToRosTime(person.frame.stamp_ns);
    })) << graph_.status().state
        << graph_.status().detail;
    return *infos_.messages().back();
  }

  static RgbdMessages Paired(RgbdFrame frame) {
    frame.depth_stamp_ns = frame.stamp_ns;
    return MessagesOf(frame);
  }

  ros::NodeHandle node_;
  ros::Publisher skeletons_;
  Recorder<HumanInfo> infos_{kStaticInfoTopic};
  NodeletGraph graph_;
};

/// How this process gets the topic from its publisher.
std::string TransportOf(const std::string& topic) {
  XmlRpc::XmlRpcClient client("localhost", ros::XMLRPCManager::instance()->getServerPort());
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue answer;  // code, text, links
  EXPECT_TRUE(client.execute("getBusInfo", caller, answer));
  XmlRpc::XmlRpcValue& links = answer[2];
  std::string transports;
  for (int i = 0; i < links.size(); ++i) {
    const bool is_subscription = std::string(links[i][2]) == "i";
    if (is_subscription && std::string(links[i][4]) == topic)
      transports += std::string(links[i][3]);
  }
  return transports;
}

TEST_F(HumanRemovalGraph, ImagesReachMappingWithoutACopy) {
  const Recorder<sensor_msgs::Image> depth(kStaticDepthTopic);
  const Recorder<sensor_msgs::Image> depth_again(kStaticDepthTopic);
  const Recorder<sensor_msgs::Image> mask(kStaticMaskTopic);
  const Recorder<sensor_msgs::Image> mask_again(kStaticMaskTopic);
  Start();
  Process(SyntheticPerson(0));
  ASSERT_TRUE(depth.WaitForSize(1) && depth_again.WaitForSize(1));
  ASSERT_TRUE(mask.WaitForSize(1) && mask_again.WaitForSize(1));
  EXPECT_EQ(depth.messages()[0].get(), depth_again.messages()[0].get());
  EXPECT_EQ(mask.messages()[0].get(), mask_again.messages()[0].get());
  // Pointers of a link within the process are the publisher's; others carry bytes.
  EXPECT_EQ(TransportOf("/static/depth"), "INTRAPROCESS");
  EXPECT_EQ(TransportOf("/static/mask"), "INTRAPROCESS");
}

TEST_F(HumanRemovalGraph, SwitchedOffPassesTheVeryMessages) {
  graph_.SetParam("/human_removal/enabled", false);
  const Recorder<sensor_msgs::Image> depth(kStaticDepthTopic);
  const Recorder<sensor_msgs::Image> mask(kStaticMaskTopic);
  Start();
  const RgbdMessages sent = Paired(SyntheticPerson(0).frame);
  graph_.Publish(sent);
  ASSERT_TRUE(graph_.WaitForProcessed(1));
  ASSERT_TRUE(depth.WaitForSize(1) && mask.WaitForSize(1) && infos_.WaitForSize(1));
  EXPECT_EQ(depth.messages()[0].get(), sent.depth.get());
  EXPECT_EQ(cv::countNonZero(ToMask(mask.messages()[0], "")), 0);
  EXPECT_FALSE(infos_.messages()[0]->removal_enabled);
  EXPECT_FALSE(graph_.status().human_removal);
}

TEST_F(HumanRemovalGraph, MissingAndLateKeypointsStopNobody) {
  Start();
  for (int i = 0; i < 5; ++i) {
    const HumanInfo info = Process(SyntheticPerson(i));
    EXPECT_TRUE(info.removal_enabled);
    EXPECT_EQ(info.mask_age_s, -1);
  }
  PublishKeypoints(SyntheticPerson(3));
  ros::WallDuration(0.2).sleep();
  const HumanInfo late = Process(SyntheticPerson(6));
  EXPECT_FALSE(late.has_own_keypoints);
  EXPECT_NEAR(late.mask_age_s, 0.1, 1e-3);
  EXPECT_EQ(late.num_people, 1) << "carried from the frame of the keypoints to this one";
  EXPECT_GT(late.keypoint_rate_hz, 0);
  PublishKeypoints(SyntheticPerson(7));
  ros::WallDuration(0.2).sleep();
  EXPECT_TRUE(Process(SyntheticPerson(7)).has_own_keypoints) << "they came before their frame";
  EXPECT_EQ(graph_.status().frames_processed, 7U);
  EXPECT_EQ(graph_.status().people, 1);
}

TEST_F(HumanRemovalGraph, FirstFramesWaitForTheFirstKeypoints) {
  constexpr int kWaiting = 8;
  Start();
  for (int i = 0; i < kWaiting; ++i) {
    graph_.Publish(Paired(SyntheticPerson(i).frame));
    ros::WallDuration(0.02).sleep();
  }
  EXPECT_EQ(infos_.size(), 0U);
  PublishKeypoints(SyntheticPerson(0));
  ASSERT_TRUE(infos_.WaitForSize(kWaiting)) << "none was dropped";
  for (const auto& info : infos_.messages()) EXPECT_EQ(info->num_people, 1);
}

TEST_F(HumanRemovalGraph, LateKeypointsMayBeOfABlurredFrame) {
  Start();
  const ros::Publisher info = node_.advertise<sensor_msgs::CameraInfo>(kBlurredInfoTopic, 10);
  const ros::Publisher depth = node_.advertise<sensor_msgs::Image>(kBlurredDepthTopic, 10);
  const ros::Publisher rgb = node_.advertise<sensor_msgs::Image>(kBlurredRgbTopic, 10);
  while (ros::ok() && rgb.getNumSubscribers() == 0) ros::WallDuration(0.005).sleep();
  skeletons_.publish(MessageOf({SyntheticPerson(0).skeletons.stamp_ns, {}, {}, 0}));
  EXPECT_EQ(Process(SyntheticPerson(0)).num_people, 0) << "nobody was found";
  const RgbdMessages blurred = Paired(SyntheticPerson(1).frame);
  info.publish(blurred.info);
  depth.publish(blurred.depth);
  rgb.publish(blurred.rgb);
  ros::WallDuration(0.2).sleep();
  PublishKeypoints(SyntheticPerson(1));
  ros::WallDuration(0.2).sleep();
  const HumanInfo now = Process(SyntheticPerson(2));
  EXPECT_FALSE(now.has_own_keypoints);
  EXPECT_NEAR(now.mask_age_s, 0.033, 1e-3);
  EXPECT_EQ(now.num_people, 1) << "carried from the blurred frame";
  EXPECT_EQ(infos_.size(), 2U) << "the blurred frame goes nowhere";
}

TEST_F(HumanRemovalGraph, WithoutTheTransformPeopleAreCutOutAllTheSameAndItIsToldOnce) {
  graph_.SetParam("/human_removal/frames/odom_frame", std::string("odom_init"));
  const LogLines log;
  Start();
  const auto start = ros::WallTime::now();
  int index = 0;
  while (ros::WallTime::now() - start < ros::WallDuration(1.2)) {
    PublishKeypoints(SyntheticPerson(index));
    ros::WallDuration(0.05).sleep();
    EXPECT_EQ(Process(SyntheticPerson(index++)).num_people, 1);
  }
  EXPECT_TRUE(log.WaitFor({"odom_init", kCameraFrame, "without knowing where down is"}));
}

TEST_F(HumanRemovalGraph, BadSkeletonMessagesAreSurvived) {
  const LogLines log;
  Start();
  Skeletons people = SyntheticPerson(0).skeletons;
  SkeletonsMessage unknown_layout = MessageOf(people);
  unknown_layout.layout = "mpii";
  SkeletonsMessage too_short = MessageOf(people);
  too_short.people[0].joints.resize(7);
  SkeletonsMessage no_numbers = MessageOf(people);
  for (auto& joint : no_numbers.people[0].joints) joint.u = std::nanf("");
  SkeletonsMessage crowd = MessageOf(people);
  crowd.people.resize(500, crowd.people[0]);
  SkeletonsMessage other_clock = MessageOf(people);
  other_clock.header.stamp = ros::Time(5);
  int index = 0;
  for (const auto& message : {unknown_layout, too_short, no_numbers, crowd, other_clock}) {
    skeletons_.publish(message);
    Process(SyntheticPerson(index++));
  }
  PublishKeypoints(SyntheticPerson(index));
  ros::WallDuration(0.2).sleep();
  const HumanInfo info = Process(SyntheticPerson(index));
  EXPECT_TRUE(info.has_own_keypoints);
  EXPECT_EQ(info.num_people, 1);
  EXPECT_TRUE(log.WaitFor({"/skeletons", "mpii"}));
  const std::string image = FormatStamp(SyntheticPerson(4).frame.stamp_ns);
  EXPECT_TRUE(log.WaitFor({"5.000000", image, "another clock"}));
}

TEST_F(HumanRemovalGraph, KeypointsOfFramesThatNeverComeStopNobody) {
  Start();
  for (int i = 0; i < 400; ++i) {
    PersonFrame person = SyntheticPerson(1);
    person.skeletons.stamp_ns += 1'000'000 * (1 + i % 20);  // between two frames
    PublishKeypoints(person);
  }
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Process(SyntheticPerson(i)).mask_age_s, -1);
  PublishKeypoints(SyntheticPerson(3));
  ros::WallDuration(0.2).sleep();
  EXPECT_EQ(Process(SyntheticPerson(3)).num_people, 1);
}

TEST_F(HumanRemovalGraph, DiagnosticsTellPeopleMaskAgeAndPaceOfKeypoints) {
  const Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Start();
  PublishKeypoints(SyntheticPerson(0));
  ros::WallDuration(0.2).sleep();
  for (int i = 0; i < 3; ++i) Process(SyntheticPerson(i));
  const auto values = [&](const std::string& name) {
    std::map<std::string, std::string> newest;
    for (const auto& array : diagnostics.messages()) {
      for (const auto& status : array->status) {
        if (status.name != name) continue;
        for (const auto& value : status.values) newest[value.key] = value.value;
      }
    }
    return newest;
  };
  for (const char* name : {"human_removal: people", "mapping: people"}) {
    for (int i = 0; i < 400 && values(name)["people"] != "1"; ++i) ros::WallDuration(0.01).sleep();
    auto newest = values(name);
    EXPECT_EQ(newest["people"], "1") << name;
    EXPECT_NEAR(std::stod(newest["age of the mask [s]"]), 0.066, 0.01) << name;
    EXPECT_GT(std::stod(newest["keypoints [Hz]"]), 0) << name;
    EXPECT_GT(std::stod(newest["delay of keypoints [s]"]), 0) << name;
  }
}

TEST_F(HumanRemovalGraph, AllNodeletsHearOnceThatImagesAreRectified) {
  graph_.SetParam("/camera_info/images_are_rectified", true);
  Start();
  EXPECT_TRUE(Process(SyntheticPerson(0)).removal_enabled);
  RgbdMessages without_p = Paired(SyntheticPerson(1).frame);
  auto info = boost::make_shared<sensor_msgs::CameraInfo>(*without_p.info);
  info->P.fill(0);
  without_p.info = info;
  graph_.Publish(without_p);
  EXPECT_TRUE(graph_.WaitFor([](const Status& status) { return status.frames_refused == 1; }))
      << "Mapping";
  ASSERT_TRUE(infos_.WaitForSize(2));
  EXPECT_FALSE(infos_.messages()[1]->removal_enabled) << "HumanRemoval";
}

TEST_F(HumanRemovalGraph, StartsAnewWhenABagIsRestarted) {
  Start();
  for (const int round : {0, 1}) {
    for (int i = 0; i < 3; ++i) {
      PersonFrame person = SyntheticPerson(10 * (1 - round) + i,
                                           round == 0 ? 2 * kSyntheticStartNs : kSyntheticStartNs);
      PublishKeypoints(person);
      ros::WallDuration(0.1).sleep();
      const HumanInfo info = Process(person);
      EXPECT_TRUE(info.has_own_keypoints) << round << " " << i;
      EXPECT_EQ(info.num_people, 1) << round << " " << i;
    }
  }
  EXPECT_EQ(graph_.status().resets, 1U);
  EXPECT_EQ(graph_.status().frames_processed, 3U);
}

TEST_F(HumanRemovalGraph, WaitsAgainForFirstKeypointsWhenABagIsRestarted) {
  Start();
  PublishKeypoints(SyntheticPerson(0, 2 * kSyntheticStartNs));
  ros::WallDuration(0.1).sleep();
  Process(SyntheticPerson(0, 2 * kSyntheticStartNs));
  for (int i = 0; i < 3; ++i) {
    graph_.Publish(Paired(SyntheticPerson(i).frame));
    ros::WallDuration(0.05).sleep();
  }
  EXPECT_EQ(infos_.size(), 1U);
  PublishKeypoints(SyntheticPerson(0));
  ASSERT_TRUE(infos_.WaitForSize(4));
  EXPECT_EQ(infos_.messages()[1]->num_people, 1);
}

TEST_F(HumanRemovalGraph, UnusableImagesAreRefusedAndGoodOnesGoOn) {
  Start();
  Process(SyntheticPerson(0));
  RgbdMessages bad = Paired(SyntheticPerson(1).frame);
  auto depth = boost::make_shared<sensor_msgs::Image>(*bad.depth);
  depth->encoding = "yuv422";
  bad.depth = depth;
  graph_.Publish(bad);
  EXPECT_TRUE(graph_.WaitFor([](const Status& status) { return status.frames_refused == 1; }));
  EXPECT_THAT(graph_.status().detail, ::testing::HasSubstr("/sharp/depth_registered/image_rect"));
  EXPECT_TRUE(Process(SyntheticPerson(2)).removal_enabled);
}

TEST_F(HumanRemovalGraph, DrawsForThoseWhoListen) {
  const Recorder<sensor_msgs::Image> overlay(kOverlayTopic);
  const Recorder<visualization_msgs::MarkerArray> markers(kSkeletonMarkersTopic);
  Start();
  const PersonFrame person = SyntheticPerson(0);
  PublishKeypoints(person);
  ros::WallDuration(0.2).sleep();
  Process(person);
  ASSERT_TRUE(overlay.WaitForSize(1) && markers.WaitForSize(1));
  EXPECT_EQ(overlay.messages()[0]->encoding, "rgb8");
  EXPECT_EQ(markers.messages()[0]->markers.size(), 3U);
  EXPECT_TRUE(markers.messages()[0]->markers[1].header.stamp.isZero());
}

TEST_F(HumanRemovalGraph, WrongParametersStopTheStart) {
  graph_.SetParam("/human_removal/min_cut/radius_m", -1.0);
  EXPECT_FALSE(graph_.Start());
  graph_.Stop();
  graph_.SetParam("/mapping/ros/human_removal", true);
  graph_.SetParam("/human_removal/ros/no_such_key", 1);
  EXPECT_FALSE(graph_.Start());
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  ros::init(argc, argv, "human_removal_test");
  ros::NodeHandle keep_alive;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
