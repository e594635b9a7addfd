#include <memory>
#include <mutex>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "posefusion/skeleton/clock_check.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/keypoint_rate_meter.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/human_removal_publishers.h"
#include "posefusion_ros/nodelets/human_removal_worker.h"
#include "posefusion_ros/nodelets/rgbd_subscriber.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Takes people out of the frames under sharp/: keypoints in, static depth and person mask out, for
/// every frame, whatever happens to its keypoints. The work is done in HumanRemovalWorker's thread.
class HumanRemovalNodelet : public CheckedNodelet {
 private:
  void Start() override {
    ros::NodeHandle node = getNodeHandle();
    const auto config = ReadConfig<HumanRemovalNodeletConfig>(getPrivateNodeHandle());
    const RgbdTopics topics{kSharpRgbTopic, kSharpDepthTopic, kSharpInfoTopic};
    const RgbdTopics names{node.resolveName(topics.rgb), node.resolveName(topics.depth),
                           node.resolveName(topics.info)};
    skeletons_topic_ = node.resolveName(kSkeletonsTopic);
    clock_check_.emplace(skeletons_topic_);
    // What may throw comes before topics: the manager cannot take them back from half a nodelet.
    worker_ = std::make_unique<HumanRemovalWorker>(config, names, MakeCallbacks());
    const InputConfig& input = config.ros.input;
    const auto queue_size =
        static_cast<std::uint32_t>(input.lossless ? 0 : input.subscriber_queue_size);
    publishers_ = std::make_unique<HumanRemovalPublishers>(node, queue_size);
    skeletons_ = node.subscribe<SkeletonsMessage>(
        kSkeletonsTopic, queue_size,
        [this](const boost::shared_ptr<const SkeletonsMessage>& m) { OnSkeletons(*m); });
    subscriber_ =
        std::make_unique<RgbdSubscriber>(node, topics, input, config.ros.input_is_paired,
                                         [this](const RgbdMessages& frame) { OnFrame(frame); });
    NODELET_INFO_STREAM("removal of people " << (config.removal.enabled ? "on" : "off")
                                             << ", keypoints from " << skeletons_topic_);
  }

  HumanRemovalWorker::Callbacks MakeCallbacks() {
    HumanRemovalWorker::Callbacks callbacks;
    callbacks.frame = [this](const RemovalResult& result) {
      publishers_->Publish(result, CurrentPace());
    };
    callbacks.log_error = [this](const std::string& text) { NODELET_ERROR_STREAM(text); };
    callbacks.log_info = [this](const std::string& text) { NODELET_WARN_STREAM(text); };
    return callbacks;
  }

  void OnFrame(const RgbdMessages& frame) {
    CompareClocks(ToStampNs(frame.rgb->header.stamp));
    worker_->Push(frame);
  }

  /// Keypoints that came since the frame before; not when a bag has been restarted in between.
  void CompareClocks(StampNs image_ns) {
    if (keypoints_ns_ && image_ns > image_ns_) {
      if (const auto note = clock_check_->Compare(*keypoints_ns_, image_ns)) {
        NODELET_ERROR_STREAM(*note);
      }
    }
    keypoints_ns_.reset();
    image_ns_ = image_ns;
  }

  void OnSkeletons(const SkeletonsMessage& message) {
    try {
      Skeletons skeletons = ToSkeletons(message, skeletons_topic_).skeletons;
      trouble_.AllWell();
      keypoints_ns_ = skeletons.stamp_ns;
      NotePace((ros::Time::now() - message.header.stamp).toSec());
      worker_->PushKeypoints(std::move(skeletons));
    } catch (const std::exception& error) {
      trouble_.Report(error.what(), SteadyNowS());
    }
  }

  void NotePace(double delay_s) {
    const std::lock_guard<std::mutex> lock(mutex_);
    rate_meter_.Note(SteadyNowS(), delay_s);
  }
  KeypointPace CurrentPace() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {rate_meter_.RateHz(SteadyNowS()), rate_meter_.delay_s()};
  }

  static constexpr double kErrorPeriodS = 5;

  std::string skeletons_topic_;  ///< resolved
  std::optional<ClockCheck> clock_check_;
  std::optional<StampNs> keypoints_ns_;  ///< the newest since the newest frame
  StampNs image_ns_ = -1;                ///< of the newest frame
  TroubleLog trouble_{kErrorPeriodS,
                      [this](const std::string& text) { NODELET_ERROR_STREAM(text); },
                      [this](const std::string& text) { NODELET_INFO_STREAM(text); }};
  std::mutex mutex_;  ///< guards the one below
  KeypointRateMeter rate_meter_;
  std::unique_ptr<HumanRemovalPublishers> publishers_;
  std::unique_ptr<HumanRemovalWorker> worker_;  // ends before what it publishes with
  ros::Subscriber skeletons_;
  std::unique_ptr<RgbdSubscriber> subscriber_;  // last: no frame comes while the rest ends
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::HumanRemovalNodelet, nodelet::Nodelet)
