#include "posefusion_ros/static_frame_buffer.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace posefusion {
namespace {

using Stamps = std::vector<double>;

template <class Message>
boost::shared_ptr<Message> At(double stamp_s) {
  auto message = boost::make_shared<Message>();
  message->header.stamp.fromSec(stamp_s);
  return message;
}

constexpr double kDepthLag = 0.01;

/// Feeds a buffer and notes what it lets go.
class StaticFrames : public testing::Test {
 protected:
  void Frame(double stamp_s) {
    RgbdMessages frame;
    frame.rgb = At<sensor_msgs::Image>(stamp_s);
    frame.depth = At<sensor_msgs::Image>(stamp_s + kDepthLag);
    Note(buffer_.AddFrame(frame));
  }
  void Depth(double stamp_s) {
    Note(buffer_.AddDepth(At<sensor_msgs::Image>(stamp_s + kDepthLag)));
  }
  void Mask(double stamp_s) { Note(buffer_.AddMask(At<sensor_msgs::Image>(stamp_s))); }
  void Info(double stamp_s) { Note(buffer_.AddInfo(At<HumanInfo>(stamp_s))); }
  void Removed(double stamp_s) {
    Depth(stamp_s);
    Mask(stamp_s);
    Info(stamp_s);
  }
  void Note(const std::vector<MappingMessages>& released) {
    for (const MappingMessages& frame : released) {
      const ros::Time stamp = frame.rgbd.rgb->header.stamp;
      EXPECT_EQ(frame.human_info->header.stamp, stamp);
      EXPECT_EQ(frame.mask->header.stamp, stamp);
      EXPECT_EQ(frame.static_depth->header.stamp, frame.rgbd.depth->header.stamp);
      released_.push_back(stamp.toSec());
    }
  }

  StaticFrameBuffer buffer_{2};
  Stamps released_;
};

TEST_F(StaticFrames, GoWhenTheirInfoHasCome) {
  Frame(1);
  Depth(1);
  Mask(1);
  EXPECT_EQ(released_, Stamps());
  EXPECT_EQ(buffer_.size(), 1U);
  Info(1);
  EXPECT_EQ(released_, Stamps{1});
  EXPECT_EQ(buffer_.size(), 0U);
}

TEST_F(StaticFrames, GoWhicheverComesLast) {
  Removed(1);
  EXPECT_EQ(released_, Stamps());
  Frame(1);
  EXPECT_EQ(released_, Stamps{1});
  Frame(2);
  Info(2);
  Depth(2);
  Mask(2);
  EXPECT_EQ(released_, (Stamps{1, 2}));
}

TEST_F(StaticFrames, GoInStampOrderWhenImagesComeLate) {
  Frame(1);
  Frame(1.1);
  Depth(1);
  Info(1);
  Removed(1.1);
  EXPECT_EQ(released_, Stamps());
  Mask(1);
  EXPECT_EQ(released_, (Stamps{1, 1.1}));
  EXPECT_EQ(buffer_.num_evicted(), 0U);
}

TEST_F(StaticFrames, LeftOutByHumanRemovalAreEvicted) {
  for (const double stamp : {1.0, 1.1, 1.2, 1.3}) Frame(stamp);
  Removed(1.2);
  EXPECT_EQ(released_, Stamps{1.2});
  EXPECT_EQ(buffer_.num_evicted(), 2U);
  EXPECT_EQ(buffer_.size(), 1U);
}

TEST_F(StaticFrames, AreHeldForALimitedTime) {
  for (int i = 0; i < 100; ++i) Frame(10 + 0.1 * i);
  EXPECT_LE(buffer_.size(), 21U);
  EXPECT_GE(buffer_.size(), 20U);
  EXPECT_EQ(buffer_.size() + buffer_.num_evicted(), 100U);
  Removed(10 + 0.1 * 99);
  EXPECT_EQ(released_.size(), 1U) << "it goes on";
}

TEST_F(StaticFrames, OfARestartedBagComeAnew) {
  for (const double stamp : {50.0, 50.1}) Frame(stamp);
  Frame(1);
  Removed(50.0);
  Removed(50.1);
  EXPECT_EQ(released_, Stamps());
  Removed(1);
  EXPECT_EQ(released_, Stamps{1});
}

}  // namespace
}  // namespace posefusion
