#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/log_lines.h"
#include "test/ros/recorder.h"
#include "test/skeleton/sample_skeletons.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

using testing::PersonAt;
using testing::WritePeople;
using testing::WriteText;

constexpr StampNs kSecond = 1'000'000'000;
constexpr const char* kName = "/skeleton_ingest";

/// The nodelet in this process, with a camera and a sender of keypoints in front of it.
class SkeletonIngest : public ::testing::Test {
 protected:
  SkeletonIngest()
      : image_(node_.advertise<sensor_msgs::Image>(kCameraRgbTopic, 100)),
        skeletons_in_(node_.advertise<SkeletonsMessage>(kSkeletonsInTopic, 100)),
        loader_(false) {}
  ~SkeletonIngest() override {
    loader_.clear();
    ros::param::del(kName);
  }

  bool Load(const std::string& source) {
    ros::param::set(std::string(kName) + "/source", source);
    return loader_.load(kName, "posefusion/SkeletonIngest", nodelet::M_string(), {});
  }
  bool LoadFolder() {
    ros::param::set(std::string(kName) + "/folder", folder_.path());
    if (!Load("folder")) return false;
    return WaitForReader(image_);
  }

  static bool WaitForReader(const ros::Publisher& publisher) {
    for (int i = 0; i < 1000 && publisher.getNumSubscribers() == 0; ++i) {
      ros::WallDuration(0.01).sleep();
    }
    ros::WallDuration(0.2).sleep();  // and the recorder of what comes out
    return publisher.getNumSubscribers() > 0;
  }

  void PublishImage(StampNs stamp_ns) {
    sensor_msgs::Image image;
    image.header.stamp = ToRosTime(stamp_ns);
    image.header.frame_id = "camera";
    image.width = 640;
    image.height = 480;
    image_.publish(image);
  }
  void PublishSkeletons(StampNs stamp_ns, const std::vector<Skeleton>& people,
                        const std::string& layout = "coco18") {
    Skeletons skeletons;
    skeletons.people = people;
    std_msgs::Header header;
    header.stamp = ToRosTime(stamp_ns);
    SkeletonsMessage message = ToSkeletonsMessage(skeletons, header);
    message.layout = layout;
    skeletons_in_.publish(message);
  }

  /// Stamps in whole seconds of what has come out.
  std::vector<int> Seconds() const {
    std::vector<int> seconds;
    for (const auto& message : skeletons_.messages()) {
      seconds.push_back(static_cast<int>(message->header.stamp.sec));
    }
    return seconds;
  }

  TemporaryFolder folder_;
  ros::NodeHandle node_;
  ros::Publisher image_;
  ros::Publisher skeletons_in_;
  Recorder<SkeletonsMessage> skeletons_{kSkeletonsTopic};
  LogLines log_;
  nodelet::Loader loader_;
};

TEST_F(SkeletonIngest, FolderComesOutWithTheImagesOfItsArrival) {
  WritePeople(folder_ / "1.0.json", {PersonAt(10, 20)});
  WritePeople(folder_ / "2.0.json", {});
  WriteText(folder_ / "3.0.json", "nonsense");
  WritePeople(folder_ / "4.0.json", {PersonAt(5000, 20)});
  WriteText(folder_ / "arrival.txt", "1.0 2.5\n");
  ASSERT_TRUE(LoadFolder());
  for (int second = 1; second <= 5; ++second) PublishImage(second * kSecond);
  ASSERT_TRUE(skeletons_.WaitForSize(3));
  EXPECT_EQ(Seconds(), (std::vector<int>{2, 1, 4}));
  EXPECT_EQ(skeletons_.messages()[0]->people.size(), 0U);
  EXPECT_EQ(skeletons_.messages()[1]->people.size(), 1U);
  EXPECT_EQ(skeletons_.messages()[1]->header.frame_id, "camera");
  EXPECT_EQ(skeletons_.messages()[2]->people.size(), 0U) << "outside the image";
}

TEST_F(SkeletonIngest, NumberedFilesCountFromTheStartOfTheBagWheneverItRestarts) {
  WritePeople(folder_ / "a_000000000001_keypoints.json", {PersonAt(10, 20)});
  ASSERT_TRUE(LoadFolder());
  for (const int second : {7, 8, 9, 7, 8, 9}) PublishImage(second * kSecond);
  ASSERT_TRUE(skeletons_.WaitForSize(2));
  EXPECT_EQ(Seconds(), (std::vector<int>{8, 8}));
}

TEST_F(SkeletonIngest, TopicIsCheckedAndGoesOnAfterBadMessages) {
  ASSERT_TRUE(Load("topic"));
  ASSERT_TRUE(WaitForReader(skeletons_in_) && WaitForReader(image_));
  PublishImage(1 * kSecond);
  ros::WallDuration(0.2).sleep();
  PublishSkeletons(1 * kSecond, {PersonAt(10, 20), PersonAt(-900, 20)});
  PublishSkeletons(2 * kSecond, {PersonAt(10, 20)}, "mpii");
  PublishSkeletons(3 * kSecond, std::vector<Skeleton>(20, PersonAt(10, 20)));
  PublishSkeletons(4 * kSecond, std::vector<Skeleton>(500, PersonAt(10, 20)));
  PublishSkeletons(500 * kSecond, {});
  PublishSkeletons(501 * kSecond, {});
  ASSERT_TRUE(skeletons_.WaitForSize(5));
  EXPECT_EQ(Seconds(), (std::vector<int>{1, 3, 4, 500, 501}));
  EXPECT_EQ(skeletons_.messages()[0]->people.size(), 1U) << "the other is not in the image";
  EXPECT_EQ(skeletons_.messages()[1]->people.size(), 15U);
  EXPECT_EQ(skeletons_.messages()[1]->layout, "coco18");
  EXPECT_TRUE(log_.WaitFor({"/skeletons_in", "mpii"}));
  EXPECT_TRUE(log_.WaitFor({"500.000000", "1.000000", "another clock"}));
  EXPECT_EQ(log_.Count({"another clock"}), 1U);
  EXPECT_EQ(log_.Count({"more than 15 people"}), 1U);
}

TEST_F(SkeletonIngest, NetworkFindsPeopleInSharpImages) {
  SKIP_WITHOUT_DATA("../models/tfpose_mobilenet_v2_small_cv_432x368.pb");
  ros::param::set(std::string(kName) + "/network/model",
                  DataPath("../models/tfpose_mobilenet_v2_small_cv_432x368.pb"));
  ros::Publisher sharp = node_.advertise<sensor_msgs::Image>(kSharpRgbTopic, 10);
  ASSERT_TRUE(Load("network"));
  ASSERT_TRUE(WaitForReader(sharp));
  cv::Mat rgb;
  cv::cvtColor(cv::imread(DataPath("../models/test_p1.jpg")), rgb, cv::COLOR_BGR2RGB);
  std_msgs::Header header;
  header.stamp = ros::Time(7);
  header.frame_id = "camera";
  sharp.publish(ToRgb8Message(rgb, header));
  ASSERT_TRUE(skeletons_.WaitForSize(1));
  EXPECT_EQ(Seconds(), (std::vector<int>{7}));
  EXPECT_EQ(skeletons_.messages()[0]->people.size(), 1U);
  EXPECT_EQ(skeletons_.messages()[0]->header.frame_id, "camera");
}

TEST_F(SkeletonIngest, RefusesToStartWithoutAFolder) {
  EXPECT_FALSE(Load("folder")) << "none given";
  EXPECT_TRUE(log_.WaitFor({"/skeleton_ingest/folder: must be given"}));
  ros::param::set(std::string(kName) + "/folder", "/nonexistent/keypoints");
  EXPECT_FALSE(Load("folder"));
  EXPECT_TRUE(log_.WaitFor({"/nonexistent/keypoints"}));
  EXPECT_FALSE(Load("nonsense"));
  EXPECT_TRUE(log_.WaitFor({"skeleton_ingest.source", "nonsense"}));
}

TEST_F(SkeletonIngest, RefusesToStartWithoutANetworkAndNamesItsParameter) {
  EXPECT_FALSE(Load("network")) << "no model";
  EXPECT_TRUE(log_.WaitFor({"/skeleton_ingest/network", "model: is empty"}));
  ros::param::set(std::string(kName) + "/network/model", "/nonexistent/graph.pb");
  EXPECT_FALSE(Load("network"));
  EXPECT_TRUE(log_.WaitFor({"/skeleton_ingest/network", "model: /nonexistent/graph.pb"}));
  WriteText(folder_ / "picture.pb", "\xff\xd8\xff\xe0JFIF");
  ros::param::set(std::string(kName) + "/network/model", folder_ / "picture.pb");
  EXPECT_FALSE(Load("network"));
  EXPECT_TRUE(log_.WaitFor({"/skeleton_ingest/network", "model: ", "is no TensorFlow graph"}));
}

TEST_F(SkeletonIngest, NoneIsQuiet) {
  ASSERT_TRUE(Load("none"));
  ros::WallDuration(0.2).sleep();
  EXPECT_EQ(image_.getNumSubscribers(), 0U);
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "skeleton_ingest_test");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
