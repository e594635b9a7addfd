// run_dataset on a bag as a robot records it: images, tf and keypoints.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sys/wait.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "posefusion/common/atomic_file.h"
#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/conversions.h"
#include "test/support/rendered_source.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

constexpr int kFrames = 8;

class RunDatasetBag : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::RenderedSource source(kFrames);
    BagWriter writer(folder_ / "a.bag", "camera");
    for (int i = 0; const auto frame = source.Next(); ++i) {
      writer.Write(*frame);
      Skeletons nobody;
      nobody.stamp_ns = nobody.arrival_ns = frame->stamp_ns;
      writer.Write(nobody);
      writer.WriteOther([&](rosbag::Bag& bag) {
        std_msgs::Header header;
        header.stamp = ToRosTime(frame->stamp_ns);
        header.frame_id = "camera";
        tf2_msgs::TFMessage tf;
        tf.transforms = {ToTransformMessage(testing::SwayingPose(i), "odom", header)};
        bag.write("/tf", header.stamp, tf);
      });
    }
    writer.Close();
  }

  /// Exit code; what is printed goes into the file log.
  int Run(const std::string& options) const {
    const std::string command = std::string(POSEFUSION_RUN_DATASET) + " " + (folder_ / "a.bag") +
                                " --out " + (folder_ / "out") + " " + options + " > " +
                                (folder_ / "log") + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string Log() const { return ReadWholeFile(folder_ / "log"); }
  nlohmann::json Report() const {
    return nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(RunDatasetBag, TakesOdometryFromTfWhenItIsNamed) {
  ASSERT_EQ(Run(""), 0) << Log();
  EXPECT_EQ(Report()["odometry_prior"]["used"], 0);
  ASSERT_EQ(Run("--odometry tf:odom"), 0) << Log();
  EXPECT_EQ(Report()["odometry_prior"]["used"], kFrames - 1);
  EXPECT_EQ(Report()["config"]["odometry"], "tf:odom");
  EXPECT_EQ(Run("--odometry tf:odom_init"), 1);
  EXPECT_NE(Log().find("no way from odom_init to the camera"), std::string::npos) << Log();
}

TEST_F(RunDatasetBag, TakesKeypointsOfItsOwnOrOfTheTopicThatIsNamed) {
  ASSERT_EQ(Run(""), 0) << Log();
  EXPECT_EQ(Report()["keypoints"]["arrived"], kFrames);
  ASSERT_EQ(Run("--keypoints topic:/skeletons_in --keypoint-rate 15"), 0) << Log();
  EXPECT_EQ(Report()["keypoints"]["arrived"], kFrames / 2);
  ASSERT_EQ(Run("--keypoints none"), 0) << Log();
  EXPECT_EQ(Report()["keypoints"]["arrived"], 0);
  EXPECT_EQ(Run("--keypoints topic:people"), 1);
  EXPECT_NE(Log().find("/people"), std::string::npos) << Log();
}

}  // namespace
}  // namespace posefusion
