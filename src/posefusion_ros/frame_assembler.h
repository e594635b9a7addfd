#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <deque>
#include <optional>
#include <vector>

#include "posefusion/image/rgbd_frame.h"
#include "posefusion_ros/stamp_matcher.h"

namespace posefusion {

/// The messages that make one frame, as they came.
struct RgbdMessages {
  sensor_msgs::ImageConstPtr rgb;
  sensor_msgs::ImageConstPtr depth;
  sensor_msgs::CameraInfoConstPtr info;  ///< null when no camera_info has come yet
};

/// Names under which the three streams are known, for error messages.
struct RgbdTopics {
  std::string rgb;
  std::string depth;
  std::string info;
};

/// Makes the core's frame of the messages; colour of encoding rgb8 is shared, not copied.
/// @throws std::invalid_argument naming the topic for what cannot be used.
RgbdFrame ToRgbdFrame(const RgbdMessages& messages, bool images_are_rectified,
                      const RgbdTopics& topics);

/// Puts colour, depth and camera_info messages together by their stamps (see StampMatcher). A bag
/// read directly and the same bag played through topics give the same frames.
///
/// A pair waits for the camera_info of its stamp as long as camera_infos come for each image;
/// otherwise the latest one counts. Not thread-safe.
class FrameAssembler {
 public:
  /// `waits_for_info` false: the latest camera_info counts at once, of whatever stamp.
  explicit FrameAssembler(const StampMatcherOptions& options, bool waits_for_info = true)
      : matcher_(options), infos_come_per_image_(waits_for_info), waits_for_info_(waits_for_info) {}

  /// Each returns the frames that have become complete, in stamp order.
  std::vector<RgbdMessages> AddRgb(const sensor_msgs::ImageConstPtr& rgb);
  std::vector<RgbdMessages> AddDepth(const sensor_msgs::ImageConstPtr& depth);
  std::vector<RgbdMessages> AddInfo(const sensor_msgs::CameraInfoConstPtr& info);

  /// The frames left when nothing more comes.
  std::vector<RgbdMessages> Flush();

  /// Smallest stamp difference in seconds of what waits for a partner.
  std::optional<double> ClosestMissS() const { return matcher_.ClosestMissS(); }

 private:
  using Matcher = StampMatcher<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr>;

  std::vector<RgbdMessages> Complete(std::vector<Matcher::Pair> pairs, std::size_t max_waiting);
  sensor_msgs::CameraInfoConstPtr FindInfo(const ros::Time& stamp) const;

  Matcher matcher_;
  std::deque<Matcher::Pair> waiting_for_info_;
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  ///< the latest, oldest first
  bool infos_come_per_image_;
  bool waits_for_info_;
};

}  // namespace posefusion
