#include "posefusion_ros/bag_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/conversions.h"
#include "test/ros/synthetic_room.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int kNumFrames = 6;

void WriteBag(const std::string& path, const std::vector<RgbdFrame>& frames) {
  BagWriter writer(path, "camera_rgb_optical_frame");
  for (const auto& frame : frames) writer.Write(frame);
  writer.Close();
}

std::vector<RgbdFrame> SyntheticFrames() {
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < kNumFrames; ++i) frames.push_back(SyntheticFrame(i));
  return frames;
}

void ExpectEqual(const RgbdFrame& a, const RgbdFrame& b) {
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(a.depth_stamp_ns, b.depth_stamp_ns);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(cv::norm(a.rgb, b.rgb, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.depth_m, b.depth_m, cv::NORM_INF), 0);
}

void ExpectSameFrames(FrameSource& a, FrameSource& b, int max_frames) {
  for (int i = 0; i < max_frames; ++i) {
    const auto frame = a.Next();
    const auto other = b.Next();
    ASSERT_EQ(frame.has_value(), other.has_value()) << i;
    if (!frame) return;
    ExpectEqual(*frame, *other);
  }
}

TEST(BagSource, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  auto frames = SyntheticFrames();
  for (auto& frame : frames) frame.camera.distortion = {0.1, -0.2, 0.01, 0.02, 0.3};
  frames[2].depth_m(cv::Rect(0, 0, 30, 30)) = 0;
  frames[3].depth_m = 0;
  WriteBag(folder / "a.bag", frames);
  BagSource source(folder / "a.bag");
  EXPECT_EQ(source.NumFrames(), kNumFrames);
  for (const auto& frame : frames) {
    const auto read = source.Next();
    ASSERT_TRUE(read);
    ExpectEqual(*read, frame);
  }
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Next());
}

TEST(BagSource, EqualsTheFolderThatTheBagWasMadeOf) {
  SKIP_WITHOUT_DATA("fr1_xyz");
  const TemporaryFolder folder;
  constexpr int kMaxFrames = 40;
  TumFolderSource recorded(DataPath("fr1_xyz"));
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < kMaxFrames; ++i) frames.push_back(*recorded.Next());
  WriteBag(folder / "fr1.bag", frames);
  BagSource source(folder / "fr1.bag");
  TumFolderSource again(DataPath("fr1_xyz"));
  ExpectSameFrames(source, again, kMaxFrames);
}

TEST(BagSource, MissingOrCutOffBagsAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { BagSource source(folder / "none.bag"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none.bag")));
  std::ofstream(folder / "text.bag") << "no bag";
  EXPECT_THAT([&] { BagSource source(folder / "text.bag"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("text.bag")));
  WriteBag(folder / "cut.bag", SyntheticFrames());
  std::filesystem::resize_file(folder / "cut.bag",
                               std::filesystem::file_size(folder / "cut.bag") / 2);
  EXPECT_THAT([&] { BagSource source(folder / "cut.bag"); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cut.bag"), HasSubstr("cut"))));
}

TEST(BagSource, MissingTopicsAreNamedWithThoseThatAreThere) {
  const TemporaryFolder folder;
  WriteBag(folder / "a.bag", SyntheticFrames());
  BagSourceOptions options;
  options.topics.depth = "kinect/depth";
  EXPECT_THAT(
      [&] { BagSource source(folder / "a.bag", options); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("a.bag"), HasSubstr("/kinect/depth"),
                                              HasSubstr("/camera/depth_registered/image_rect"))));
  options = {};
  options.topics.info = "/kinect/info";
  EXPECT_THAT([&] { BagSource source(folder / "a.bag", options); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/kinect/info")));
}

TEST(BagSource, GoesOnBehindABadFrame) {
  const TemporaryFolder folder;
  auto frames = SyntheticFrames();
  frames[1].depth_m = frames[1].depth_m(cv::Rect(0, 0, 80, 60)).clone();
  WriteBag(folder / "a.bag", frames);
  BagSource source(folder / "a.bag");
  ExpectEqual(source.Next().value(), frames[0]);
  EXPECT_THAT([&] { source.Next(); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("a.bag"), HasSubstr("depth_registered"), HasSubstr("80x60"))));
  ExpectEqual(source.Next().value(), frames[2]);
}

TEST(BagSource, TellsOnceThatStampsGoBack) {
  const TemporaryFolder folder;
  auto frames = SyntheticFrames();
  rosbag::Bag bag(folder / "back.bag", rosbag::bagmode::Write);
  for (int i = 0; i < 8; ++i) {  // frames 0 1 2 3, 0 1, 4 5 by header, in order of recording
    const auto& frame = frames[static_cast<std::size_t>(i < 4 ? i : i < 6 ? i - 4 : i - 2)];
    std_msgs::Header header;
    header.stamp = ToRosTime(frame.stamp_ns);
    const ros::Time recorded = ToRosTime(1'000'000'000LL * (100 + i));
    bag.write("/camera/rgb/camera_info", recorded, ToCameraInfo(frame.camera, header));
    bag.write("/camera/rgb/image_rect_color", recorded, *ToRgb8Message(frame.rgb, header));
    bag.write("/camera/depth_registered/image_rect", recorded,
              *ToDepthMessage(frame.depth_m, header));
  }
  bag.close();
  BagSource source(folder / "back.bag");
  std::vector<StampNs> stamps;
  int num_errors = 0;
  for (bool more = true; more;) {
    try {
      const auto frame = source.Next();
      more = frame.has_value();
      if (more) stamps.push_back(frame->stamp_ns);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("go back"));
      ++num_errors;
    }
  }
  EXPECT_EQ(num_errors, 1);
  ASSERT_EQ(stamps.size(), 6U);
  EXPECT_TRUE(std::is_sorted(stamps.begin(), stamps.end()));
}

TEST(BagWriter, LeavesNothingWithoutClose) {
  const TemporaryFolder folder;
  { BagWriter(folder / "a.bag", "camera").Write(SyntheticFrame(0)); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THAT([] { BagWriter writer("/nonexistent/a.bag", "camera"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nonexistent/a.bag")));
}

}  // namespace
}  // namespace posefusion
