#include <sensor_msgs/Image.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>

#include "posefusion/skeleton/clock_check.h"
#include "posefusion/skeleton/skeleton_checks.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/skeleton_ingest_config.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Gives the others keypoints of people in one form, whatever they come from: checked, in COCO-18
/// order, inside the image, fifteen people at most, with the stamp of their image.
///
/// Listens to the camera's colour images, also the blurred ones: a folder's numbered files count
/// them, and its keypoints come out with the first image that is not earlier than their arrival.
/// Keypoints of a topic come out at once.
class SkeletonIngestNodelet : public CheckedNodelet {
 private:
  void Start() override {
    ros::NodeHandle node = getNodeHandle();
    config_ = ReadConfig<SkeletonIngestConfig>(getPrivateNodeHandle());
    if (config_.source == KeypointOrigin::kNone) {
      NODELET_INFO("source none: people stay in the pictures");
      return;
    }
    // What may throw comes before topics: the manager cannot take them back from half a nodelet.
    if (config_.source == KeypointOrigin::kFolder) OpenFolder();
    skeletons_ = node.advertise<SkeletonsMessage>(kSkeletonsTopic, QueueSize());
    if (config_.source == KeypointOrigin::kTopic) Subscribe(node);
    images_ = node.subscribe<sensor_msgs::Image>(
        kCameraRgbTopic, QueueSize(),
        [this](const sensor_msgs::ImageConstPtr& image) { OnImage(*image); });
  }

  std::uint32_t QueueSize() const {
    return static_cast<std::uint32_t>(config_.lossless ? 0 : config_.subscriber_queue_size);
  }

  void OpenFolder() {
    if (config_.folder.empty()) {
      throw std::invalid_argument(getPrivateNodeHandle().resolveName("folder") +
                                  ": must be given for source folder");
    }
    folder_ = std::make_unique<SkeletonFolder>(config_.folder);
    NODELET_INFO_STREAM("keypoints of " << config_.folder);
  }

  void Subscribe(ros::NodeHandle& node) {
    topic_ = node.resolveName(kSkeletonsInTopic);
    clock_check_ = std::make_unique<ClockCheck>(topic_);
    messages_ = node.subscribe<SkeletonsMessage>(
        kSkeletonsInTopic, QueueSize(),
        [this](const boost::shared_ptr<const SkeletonsMessage>& message) { OnMessage(*message); });
    NODELET_INFO_STREAM("waiting for " << topic_);
  }

  void OnImage(const sensor_msgs::Image& image) {
    if (folder_ && image.header.stamp < last_image_.header.stamp) {  // a bag restarted
      num_images_ = 0;
      Guarded([&] { folder_ = std::make_unique<SkeletonFolder>(config_.folder); });
    }
    last_image_.header = image.header;
    last_image_.width = image.width;
    last_image_.height = image.height;
    if (folder_) PublishArrived();
  }

  void PublishArrived() {
    RgbdFrame frame;  // the folder looks at nothing but these
    frame.stamp_ns = ToStampNs(last_image_.header.stamp);
    frame.index = num_images_++;
    frame.camera.width = static_cast<int>(last_image_.width);
    frame.camera.height = static_cast<int>(last_image_.height);
    Guarded([&] { folder_->Offer(frame); });
    for (const std::string& note : folder_->TakeNotes()) NODELET_WARN_STREAM(note);
    for (const Skeletons& skeletons : folder_->Take(frame.stamp_ns)) Publish(skeletons);
  }

  void OnMessage(const SkeletonsMessage& message) {
    Guarded([&] {
      ReceivedSkeletons received = ToSkeletons(message, topic_);
      if (received.num_left_out > 0 && !said_too_many_) {
        said_too_many_ = true;
        NODELET_WARN_STREAM(topic_ << ": more than " << kMaxPeople
                                   << " people; the most certain are used");
      }
      if (last_image_.width > 0) CompareWithImage(received.skeletons);
      Publish(received.skeletons);
    });
  }

  void CompareWithImage(Skeletons& skeletons) {
    const StampNs image_ns = ToStampNs(last_image_.header.stamp);
    if (const auto note = clock_check_->Compare(skeletons.stamp_ns, image_ns)) {
      NODELET_ERROR_STREAM(*note);
    }
    DropUnusable(skeletons.people, static_cast<int>(last_image_.width),
                 static_cast<int>(last_image_.height));
  }

  void Publish(const Skeletons& skeletons) {
    std_msgs::Header header = last_image_.header;  // for the camera's frame
    header.stamp = ToRosTime(skeletons.stamp_ns);
    skeletons_.publish(ToSkeletonsMessage(skeletons, header));
  }

  /// Trouble with one image's keypoints leaves that image without.
  template <class Step>
  void Guarded(const Step& step) {
    try {
      step();
      trouble_.AllWell();
    } catch (const std::exception& error) {
      trouble_.Report(error.what(), SteadyNowS());
    }
  }

  SkeletonIngestConfig config_;
  std::unique_ptr<SkeletonFolder> folder_;
  std::unique_ptr<ClockCheck> clock_check_;
  std::string topic_;              ///< resolved
  sensor_msgs::Image last_image_;  ///< header and size only
  int num_images_ = 0;
  bool said_too_many_ = false;
  TroubleLog trouble_{5, [this](const std::string& text) { NODELET_ERROR_STREAM(text); },
                      [this](const std::string& text) { NODELET_INFO_STREAM(text); }};
  ros::Publisher skeletons_;
  ros::Subscriber messages_;
  ros::Subscriber images_;  // last: nothing comes while the rest ends
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::SkeletonIngestNodelet, nodelet::Nodelet)
