#include <sensor_msgs/Image.h>

#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "posefusion/skeleton/clock_check.h"
#include "posefusion/skeleton/pose_network.h"
#include "posefusion/skeleton/pose_network_thread.h"
#include "posefusion/skeleton/skeleton_checks.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/diagnostics.h"
#include "posefusion_ros/nodelets/skeleton_ingest_config.h"
#include "posefusion_ros/pace_meter.h"
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
/// Keypoints of a topic come out at once. A pose network looks at sharp images in its own thread.
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
    if (config_.source == KeypointOrigin::kNetwork) LoadNetwork();
    skeletons_ = node.advertise<SkeletonsMessage>(kSkeletonsTopic, QueueSize());
    if (config_.source == KeypointOrigin::kTopic) Subscribe(node);
    if (pose_network_) StartNetwork();
    const char* images = pose_network_ ? kSharpRgbTopic : kCameraRgbTopic;
    images_topic_ = node.resolveName(images);
    images_ = node.subscribe<sensor_msgs::Image>(
        images, QueueSize(), [this](const sensor_msgs::ImageConstPtr& image) { OnImage(image); });
    diagnostics_ = std::make_unique<Diagnostics>(node, getPrivateNodeHandle(), getName());
    diagnostics_->Add("keypoints", [this](Diagnostics::Wrapper& entry) { DescribePace(entry); });
  }

  void DescribePace(Diagnostics::Wrapper& entry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double rate_hz = keypoint_pace_.RateHz(SteadyNowS());
    entry.add("rate [Hz]", rate_hz);
    entry.add("delay [s]", keypoint_pace_.newest_delay_s());
    if (rate_hz > 0) {
      entry.summaryf(diagnostic_msgs::DiagnosticStatus::OK, "%.1f per second", rate_hz);
    } else {
      entry.summary(diagnostic_msgs::DiagnosticStatus::WARN,
                    "no keypoints come" + (topic_.empty() ? topic_ : " on " + topic_));
    }
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

  void LoadNetwork() {
    try {
      pose_network_ = std::make_unique<PoseNetwork>(config_.network);
    } catch (const std::exception& error) {
      throw std::invalid_argument(getPrivateNodeHandle().resolveName("network") + ": " +
                                  error.what());
    }
    NODELET_INFO_STREAM("keypoints by " << config_.network.model);
  }

  /// From now on the thread alone uses the network.
  void StartNetwork() {
    PoseNetworkThreadHooks hooks;
    hooks.on_skeletons = [this](const Skeletons& skeletons) { Publish(skeletons); };
    hooks.on_error = [this](const std::string& text) {
      NODELET_ERROR_STREAM_THROTTLE(kErrorPeriodS, text);
    };
    network_thread_ = std::make_unique<PoseNetworkThread>(
        [this](const cv::Mat& rgb) { return pose_network_->Detect(rgb); }, config_.network,
        std::move(hooks));
  }

  void Subscribe(ros::NodeHandle& node) {
    topic_ = node.resolveName(kSkeletonsInTopic);
    clock_check_ = std::make_unique<ClockCheck>(topic_);
    messages_ = node.subscribe<SkeletonsMessage>(
        kSkeletonsInTopic, QueueSize(),
        [this](const boost::shared_ptr<const SkeletonsMessage>& message) { OnMessage(*message); });
    NODELET_INFO_STREAM("waiting for " << topic_);
  }

  void OnImage(const sensor_msgs::ImageConstPtr& image) {
    if (folder_ && ToStampNs(image->header.stamp) < image_ns_) {  // a bag restarted
      num_images_ = 0;
      Guarded([&] { folder_ = std::make_unique<SkeletonFolder>(config_.folder); });
    }
    image_ns_ = ToStampNs(image->header.stamp);
    width_ = static_cast<int>(image->width);
    height_ = static_cast<int>(image->height);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      camera_frame_ = image->header.frame_id;
    }
    if (folder_) PublishArrived();
    if (network_thread_) {
      Guarded([&] { network_thread_->Offer(image_ns_, ToRgb(image, images_topic_)); });
    }
  }

  void PublishArrived() {
    RgbdFrame frame;  // the folder looks at nothing but these
    frame.stamp_ns = image_ns_;
    frame.index = num_images_++;
    frame.camera.width = width_;
    frame.camera.height = height_;
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
      if (width_ > 0) CompareWithImage(received.skeletons);
      Publish(received.skeletons);
    });
  }

  void CompareWithImage(Skeletons& skeletons) {
    if (const auto note = clock_check_->Compare(skeletons.stamp_ns, image_ns_)) {
      NODELET_ERROR_STREAM(*note);
    }
    DropUnusable(skeletons.people, width_, height_);
  }

  /// Of any thread.
  void Publish(const Skeletons& skeletons) {
    std_msgs::Header header;
    header.stamp = ToRosTime(skeletons.stamp_ns);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      header.frame_id = camera_frame_;
      keypoint_pace_.Note(SteadyNowS(), (ros::Time::now() - header.stamp).toSec());
    }
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

  static constexpr double kErrorPeriodS = 5;
  static constexpr double kKeypointWindowS = 2;

  SkeletonIngestConfig config_;
  std::unique_ptr<SkeletonFolder> folder_;
  std::unique_ptr<ClockCheck> clock_check_;
  std::unique_ptr<PoseNetwork> pose_network_;
  std::string topic_;         ///< of keypoints, resolved
  std::string images_topic_;  ///< resolved
  StampNs image_ns_ = 0;      ///< of the newest image
  int width_ = 0;             ///< of the newest image, pixels; 0 = none has come
  int height_ = 0;
  int num_images_ = 0;
  bool said_too_many_ = false;
  TroubleLog trouble_{kErrorPeriodS,
                      [this](const std::string& text) { NODELET_ERROR_STREAM(text); },
                      [this](const std::string& text) { NODELET_INFO_STREAM(text); }};
  std::mutex mutex_;  ///< guards those below
  std::string camera_frame_;
  PaceMeter keypoint_pace_{kKeypointWindowS};
  ros::Publisher skeletons_;
  std::unique_ptr<PoseNetworkThread> network_thread_;  // uses what is above
  ros::Subscriber messages_;
  ros::Subscriber images_;  // nothing comes while the rest ends
  std::unique_ptr<Diagnostics> diagnostics_;
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::SkeletonIngestNodelet, nodelet::Nodelet)
