#include "posefusion/dataset/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

cv::Mat NoiseImage(int type) {
  cv::Mat image(48, 64, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, 200);
  return image;
}

void ExpectRefused(const std::string& path, cv::Mat (*read)(const std::string&),
                   const std::string& message) {
  EXPECT_THAT([&] { read(path); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(path), HasSubstr(message))));
}

TEST(ImageFile, ColourComesInTheOrderRedGreenBlue) {
  const TemporaryFolder folder;
  for (const char* name : {"colour.png", "colour.jpg"}) {
    cv::imwrite(folder / name, cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 100, 200)));
    const cv::Mat rgb = ReadColourImage(folder / name);
    EXPECT_EQ(rgb.type(), CV_8UC3);
    EXPECT_NEAR(rgb.at<cv::Vec3b>(5, 5)[0], 200, 2) << name;
    EXPECT_NEAR(rgb.at<cv::Vec3b>(5, 5)[2], 10, 2) << name;
  }
}

TEST(ImageFile, DepthKeepsItsSixteenBits) {
  const TemporaryFolder folder;
  const cv::Mat depth(48, 64, CV_16UC1, cv::Scalar(54321));
  cv::imwrite(folder / "depth.png", depth);
  EXPECT_EQ(cv::norm(ReadDepthImage(folder / "depth.png"), depth), 0);
}

TEST(ImageFile, TruncatedImagesAreRefusedAtAnyLength) {
  const TemporaryFolder folder;
  for (const char* name : {"image.png", "image.jpg"}) {
    cv::imwrite(folder / name, NoiseImage(CV_8UC3));
    const std::string bytes = ReadWholeFile(folder / name);
    for (const double share : {0.02, 0.3, 0.9}) {
      const auto length = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
      WriteFileAtomically(folder / name, bytes.substr(0, length));
      ExpectRefused(folder / name, ReadColourImage, "truncated");
    }
    WriteFileAtomically(folder / name, bytes.substr(0, bytes.size() - 1));
    ExpectRefused(folder / name, ReadColourImage, "truncated");
    WriteFileAtomically(folder / name, bytes + "trailing bytes of a camera");
    EXPECT_NO_THROW(ReadColourImage(folder / name));
  }
}

TEST(ImageFile, PreviewDoesNotHideATruncatedJpeg) {
  const TemporaryFolder folder;
  const std::string path = folder / "image.jpg";
  cv::imwrite(path, NoiseImage(CV_8UC3));
  std::string bytes = ReadWholeFile(path);
  const std::string preview("\xff\xe1\x00\x06\xff\xd9\x01\x02", 8);  // a segment with an end marker
  bytes.insert(2, preview);
  WriteFileAtomically(path, bytes);
  EXPECT_NO_THROW(ReadColourImage(path));
  WriteFileAtomically(path, bytes.substr(0, bytes.size() / 2));
  ExpectRefused(path, ReadColourImage, "truncated");
}

TEST(ImageFile, OtherContentsAreRefused) {
  const TemporaryFolder folder;
  ExpectRefused(folder / "absent.png", ReadColourImage, "cannot be read");
  WriteFileAtomically(folder / "text.png", "no image");
  ExpectRefused(folder / "text.png", ReadColourImage, "neither PNG nor JPEG");
  WriteFileAtomically(folder / "empty.png", "");
  ExpectRefused(folder / "empty.png", ReadDepthImage, "neither PNG nor JPEG");
  cv::imwrite(folder / "grey.png", NoiseImage(CV_8UC1));
  ExpectRefused(folder / "grey.png", ReadDepthImage, "CV_8UC1, expected 16UC1");
}

TEST(ImageFile, WritesWhatItReads) {
  const TemporaryFolder folder;
  const cv::Mat depth = NoiseImage(CV_16UC1);
  WriteImage(depth, folder / "depth.png");
  EXPECT_EQ(cv::norm(ReadDepthImage(folder / "depth.png"), depth), 0);
  EXPECT_THAT([&] { WriteImage(depth, folder / "nowhere/depth.png"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("nowhere/depth.png")));
}

}  // namespace
}  // namespace posefusion
