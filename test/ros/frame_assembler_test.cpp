#include "posefusion_ros/frame_assembler.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

constexpr StampNs kMs = 1'000'000;
constexpr StampNs kStart = 1'000'000 * kMs;

template <class Message>
boost::shared_ptr<Message> At(StampNs offset_ms) {
  auto message = boost::make_shared<Message>();
  message->header.stamp = ToRosTime(kStart + offset_ms * kMs);
  return message;
}
constexpr auto Image = At<sensor_msgs::Image>;
constexpr auto Info = At<sensor_msgs::CameraInfo>;

TEST(FrameAssembler, WaitsForTheCameraInfoOfTheImage) {
  FrameAssembler assembler({});
  assembler.AddDepth(Image(0));
  EXPECT_TRUE(assembler.AddRgb(Image(0)).empty());
  const auto info = Info(0);
  const auto frames = assembler.AddInfo(info);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].info, info);
}

TEST(FrameAssembler, PassesOnTheVerySameMessages) {
  FrameAssembler assembler({});
  const auto rgb = Image(0);
  const auto depth = Image(0);
  assembler.AddInfo(Info(0));
  assembler.AddRgb(rgb);
  const auto frames = assembler.AddDepth(depth);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].rgb, rgb);
  EXPECT_EQ(frames[0].depth, depth);
}

TEST(FrameAssembler, GoesOnWithTheLatestCameraInfoWhenItComesOnlyOnce) {
  FrameAssembler assembler({});
  const auto latched = Info(-5000);
  assembler.AddInfo(latched);
  std::size_t num_frames = 0;
  for (int i = 0; i < 20; ++i) {
    assembler.AddDepth(Image(33 * i));
    const auto frames = assembler.AddRgb(Image(33 * i));
    num_frames += frames.size();
    for (const auto& frame : frames) EXPECT_EQ(frame.info, latched);
    if (i > 10) {
      EXPECT_EQ(frames.size(), 1U) << "no more waiting once that is known";
    }
  }
  EXPECT_EQ(num_frames, 20U);
}

TEST(FrameAssembler, NeedNotWaitForTheCameraInfoOfTheImage) {
  FrameAssembler assembler({}, false);
  const auto latched = Info(-5000);
  assembler.AddInfo(latched);
  for (int i = 0; i < 3; ++i) {
    assembler.AddDepth(Image(3000 * i));
    const auto frames = assembler.AddRgb(Image(3000 * i));
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].info, latched);
    EXPECT_TRUE(assembler.Flush().empty());
  }
}

TEST(FrameAssembler, FramesWithoutAnyCameraInfoComeWithoutIt) {
  FrameAssembler assembler({});
  assembler.AddDepth(Image(0));
  assembler.AddRgb(Image(0));
  const auto frames = assembler.Flush();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].info, nullptr);
  EXPECT_THROW(ToRgbdFrame(frames[0], false, {"rgb", "depth", "info"}), std::invalid_argument);
}

TEST(FrameAssembler, WaitsAgainAfterCameraInfosReturn) {
  FrameAssembler assembler({});
  for (int i = 0; i < 10; ++i) {
    assembler.AddDepth(Image(33 * i));
    assembler.AddRgb(Image(33 * i));
  }
  assembler.AddInfo(Info(330));
  assembler.AddDepth(Image(330));
  EXPECT_EQ(assembler.AddRgb(Image(330)).size(), 1U);
  assembler.AddDepth(Image(363));
  EXPECT_TRUE(assembler.AddRgb(Image(363)).empty());
  EXPECT_EQ(assembler.AddInfo(Info(363)).size(), 1U);
}

TEST(FrameAssembler, ForgetsEverythingWhenTimeIsTurnedBack) {
  FrameAssembler assembler({});
  assembler.AddDepth(Image(5000));
  assembler.AddRgb(Image(5000));
  assembler.AddInfo(Info(0));
  assembler.AddRgb(Image(0));
  const auto frames = assembler.AddDepth(Image(0));
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(ToStampNs(frames.back().rgb->header.stamp), kStart);
}

}  // namespace
}  // namespace posefusion
