#include "posefusion/dataset/tum_folder_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int kNumFrames = 4;

/// A folder of four frames, 0.1 s apart, depth 5 ms after colour; frame i has depth i + 1 metres.
class TumFolderSourceTest : public testing::Test {
 protected:
  TumFolderSourceTest() {
    WriteFileAtomically(folder_ / "camera.yaml",
                        "width: 32\nheight: 24\nfx: 30\nfy: 30\ncx: 15.5\ncy: 11.5\n"
                        "depth_scale: 5000\n");
    std::string rgb_list = "# colour\n# timestamp filename\n";
    std::string depth_list = "# depth\n";
    for (int i = 0; i < kNumFrames; ++i) {
      const std::string name = "rgb" + std::to_string(i) + (i % 2 == 0 ? ".png" : ".jpg");
      cv::imwrite(folder_ / name, cv::Mat(24, 32, CV_8UC3, cv::Scalar(0, 0, 200)));
      rgb_list += "10." + std::to_string(i) + " " + name + "\n";
      const std::string depth_name = "depth" + std::to_string(i) + ".png";
      cv::imwrite(folder_ / depth_name, cv::Mat(24, 32, CV_16UC1, cv::Scalar(5000 * (i + 1))));
      depth_list += "10." + std::to_string(i) + "05 " + depth_name + "\n";
    }
    WriteFileAtomically(folder_ / "rgb.txt", rgb_list);
    WriteFileAtomically(folder_ / "depth.txt", depth_list);
  }

  void ExpectRefused(const std::string& message) {
    EXPECT_THAT(
        [&] { TumFolderSource source(folder_.path()); },
        ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(folder_.path()), HasSubstr(message))));
  }

  /// The second frame cannot be had, those around it can.
  void ExpectSecondFrameBad(const std::string& message) {
    TumFolderSource source(folder_.path());
    EXPECT_TRUE(source.Next());
    EXPECT_THAT([&] { source.Next(); }, ThrowsMessage<std::runtime_error>(
                                            AllOf(HasSubstr(folder_.path()), HasSubstr(message))));
    const auto third = source.Next();
    ASSERT_TRUE(third);
    EXPECT_EQ(third->stamp_ns, 10'200'000'000);
  }

  TemporaryFolder folder_;
};

TEST_F(TumFolderSourceTest, GivesAllFramesInOrder) {
  TumFolderSource source(folder_.path());
  EXPECT_EQ(source.NumFrames(), kNumFrames);
  for (int i = 0; i < kNumFrames; ++i) {
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_NO_THROW(CheckFrame(*frame, "frame"));
    EXPECT_EQ(frame->stamp_ns, 10'000'000'000 + i * 100'000'000LL);
    EXPECT_EQ(frame->depth_stamp_ns, frame->stamp_ns + 5'000'000);
    EXPECT_FLOAT_EQ(frame->depth_m.at<float>(12, 7), static_cast<float>(i + 1));
    EXPECT_NEAR(frame->rgb.at<cv::Vec3b>(3, 3)[0], 200, 2) << "red comes first";
    EXPECT_EQ(frame->camera, source.camera());
  }
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Next());
}

TEST_F(TumFolderSourceTest, StartAndNumberCanBeLimited) {
  TumFolderOptions options;
  options.start_s = 0.1;
  options.max_frames = 2;
  TumFolderSource source(folder_.path(), options);
  EXPECT_EQ(source.NumFrames(), 2);
  EXPECT_EQ(source.Next()->stamp_ns, 10'100'000'000);
}

TEST_F(TumFolderSourceTest, ColourWithoutDepthIsLeftOut) {
  WriteFileAtomically(folder_ / "depth.txt", "10.105 depth1.png\n10.25 depth2.png\n");
  TumFolderSource source(folder_.path());
  EXPECT_EQ(source.NumFrames(), 1);
  EXPECT_EQ(source.Next()->stamp_ns, 10'100'000'000);
}

TEST_F(TumFolderSourceTest, FoldersThatAreNoneAreRefused) {
  EXPECT_THAT([] { TumFolderSource source("/nowhere"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/nowhere: no such folder")));
  std::filesystem::remove(folder_ / "depth.txt");
  ExpectRefused("depth.txt: cannot be read");
  WriteFileAtomically(folder_ / "depth.txt", "# nothing\n");
  ExpectRefused("depth.txt: lists no images");
  WriteFileAtomically(folder_ / "depth.txt", "99.0 depth0.png\n");
  ExpectRefused("no stamps of rgb.txt and depth.txt");
  WriteFileAtomically(folder_ / "depth.txt", "# depth\n10.0 depth0.png\n10.1x depth1.png\n");
  ExpectRefused("depth.txt:3: expected 'stamp filename'");
  WriteFileAtomically(folder_ / "rgb.txt", "10.0\n");
  ExpectRefused("rgb.txt:1: expected 'stamp filename'");
  std::filesystem::remove(folder_ / "camera.yaml");
  ExpectRefused("camera.yaml");
}

TEST_F(TumFolderSourceTest, MissingImageIsNamedAndSkipped) {
  std::filesystem::remove(folder_ / "depth1.png");
  ExpectSecondFrameBad("depth1.png: cannot be read");
}

TEST_F(TumFolderSourceTest, TruncatedImageIsNamedAndSkipped) {
  const std::string bytes = ReadWholeFile(folder_ / "rgb1.jpg");
  WriteFileAtomically(folder_ / "rgb1.jpg", bytes.substr(0, bytes.size() - 5));
  ExpectSecondFrameBad("rgb1.jpg: image is truncated");
}

TEST_F(TumFolderSourceTest, OtherSizeIsNamedAndSkipped) {
  cv::imwrite(folder_ / "depth1.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(1)));
  ExpectSecondFrameBad("depth1.png: image has 64x48 pixels, camera.yaml says 32x24");
}

TEST(TumFolderSource, ReadsRecordedFrames) {
  SKIP_WITHOUT_DATA("fr1_xyz");
  TumFolderSource source(DataPath("fr1_xyz"));
  EXPECT_EQ(source.NumFrames(), 300);
  EXPECT_TRUE(source.camera().HasDistortion());
  const auto frame = source.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp_ns, 1305031102175304000);
  const double mean_depth_m = cv::mean(frame->depth_m, frame->depth_m > 0)[0];
  EXPECT_GT(mean_depth_m, 0.5);
  EXPECT_LT(mean_depth_m, 5.0);
}

}  // namespace
}  // namespace posefusion
