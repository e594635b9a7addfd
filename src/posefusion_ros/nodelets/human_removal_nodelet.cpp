#include <std_srvs/SetBool.h>

#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "posefusion/skeleton/clock_check.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/gravity_finder.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/diagnostics.h"
#include "posefusion_ros/nodelets/human_removal_publishers.h"
#include "posefusion_ros/nodelets/human_removal_worker.h"
#include "posefusion_ros/nodelets/rgbd_subscriber.h"
#include "posefusion_ros/pace_meter.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/reconfigure_server.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/tf_feed.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Takes people out of the frames under sharp/: keypoints in, static depth and person mask out, for
/// every frame, whatever happens to its keypoints. The work is done in HumanRemovalWorker's thread.
class HumanRemovalNodelet : public CheckedNodelet {
 private:
  void Start() override {
    ros::NodeHandle node = getNodeHandle();
    config_ = ReadConfig<HumanRemovalNodeletConfig>(getPrivateNodeHandle());
    const RgbdTopics topics{kSharpRgbTopic, kSharpDepthTopic, kSharpInfoTopic};
    const RgbdTopics names{node.resolveName(topics.rgb), node.resolveName(topics.depth),
                           node.resolveName(topics.info)};
    skeletons_topic_ = node.resolveName(kSkeletonsTopic);
    clock_check_.emplace(skeletons_topic_);
    StartGravity(node);
    // What may throw comes before topics: the manager cannot take them back from half a nodelet.
    worker_ = std::make_unique<HumanRemovalWorker>(config_, ReadCameraInfoConfig(node), names,
                                                   MakeCallbacks());
    const InputConfig& input = config_.ros.input;
    const auto queue_size =
        static_cast<std::uint32_t>(input.lossless ? 0 : input.subscriber_queue_size);
    publishers_ = std::make_unique<HumanRemovalPublishers>(node, queue_size);
    skeletons_ = node.subscribe<SkeletonsMessage>(
        kSkeletonsTopic, queue_size,
        [this](const boost::shared_ptr<const SkeletonsMessage>& m) { OnSkeletons(*m); });
    subscriber_ =
        std::make_unique<RgbdSubscriber>(node, topics, input, config_.ros.input_is_paired,
                                         [this](const RgbdMessages& frame) { OnFrame(frame); });
    SubscribeBlurred(node);
    StartControls();
    StartDiagnostics(node);
    NODELET_INFO_STREAM("removal of people " << (config_.removal.enabled ? "on" : "off")
                                             << ", keypoints from " << skeletons_topic_);
  }

  /// Frames that may never come are not missed. They are so rare that they cannot show whether
  /// camera_infos have the stamps of images.
  void SubscribeBlurred(const ros::NodeHandle& node) {
    InputConfig input = config_.ros.input;
    input.no_data_warning_s = std::numeric_limits<double>::infinity();
    blurred_ = std::make_unique<RgbdSubscriber>(
        node, RgbdTopics{kBlurredRgbTopic, kBlurredDepthTopic, kBlurredInfoTopic}, input, true,
        [this](const RgbdMessages& frame) { worker_->PushBlurred(frame); }, false);
  }

  /// The odometry frame stands upright; without one nobody needs tf.
  void StartGravity(const ros::NodeHandle& node) {
    tf_tree_.emplace(config_.ros.reset_after_jump_back_s);
    const std::string& odom_frame = config_.frames.odom_frame;
    gravity_.emplace(odom_frame, *tf_tree_,
                     [this](const std::string& text) { NODELET_ERROR_STREAM(text); });
    if (!odom_frame.empty()) tf_feed_.emplace(node, *tf_tree_);
  }

  HumanRemovalWorker::Callbacks MakeCallbacks() {
    HumanRemovalWorker::Callbacks callbacks;
    callbacks.frame = [this](const RemovalResult& result) {
      publishers_->Publish(result, CurrentPace());
      Note(result);
    };
    callbacks.gravity = [this](const std_msgs::Header& rgb, double timeout_s) {
      return gravity_->Find(ToStampNs(rgb.stamp), rgb.frame_id, timeout_s, SteadyNowS());
    };
    callbacks.log_error = [this](const std::string& text) { NODELET_ERROR_STREAM(text); };
    callbacks.log_info = [this](const std::string& text) { NODELET_WARN_STREAM(text); };
    return callbacks;
  }

  /// What may be changed while it runs. The service is the same as the key `enabled`.
  void StartControls() {
    ros::NodeHandle private_node = getPrivateNodeHandle();
    reconfigure_ = std::make_unique<ReconfigureServer<HumanRemovalNodeletConfig>>(
        private_node, config_,
        std::vector<std::string>{"enabled", "policy", "max_wait_s", "seeds.min_joint_confidence",
                                 "min_cut.radius_m", "min_cut.sigma_m", "min_cut.source_weight",
                                 "min_cut.max_penalty", "min_cut.reach_m",
                                 "min_cut.log_odds_weight", "min_cut.log_odds_offset"},
        [this](const HumanRemovalNodeletConfig& config) { worker_->Adopt(config.removal); },
        [this](const std::string& text) { NODELET_ERROR_STREAM(text); });
    set_human_removal_ = private_node.advertiseService("set_human_removal",
                                                       &HumanRemovalNodelet::SetHumanRemoval, this);
  }

  bool SetHumanRemoval(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    const bool enable = request.data != 0;
    const bool was = reconfigure_->config().removal.enabled;
    reconfigure_->Change([enable](HumanRemovalNodeletConfig& c) { c.removal.enabled = enable; });
    response.success = 1;
    response.message = enable ? "people are removed" : "people stay in the pictures";
    if (was == enable) response.message += ", as before";
    return true;
  }

  void StartDiagnostics(const ros::NodeHandle& node) {
    diagnostics_ = std::make_unique<Diagnostics>(node, getPrivateNodeHandle(), getName());
    diagnostics_->Add("topics", [this](Diagnostics::Wrapper& entry) {
      DescribeTopics(subscriber_->TopicStates(), config_.ros.input.no_data_warning_s, entry);
    });
    diagnostics_->Add("people", [this](Diagnostics::Wrapper& entry) { DescribePeople(entry); });
  }

  void DescribePeople(Diagnostics::Wrapper& entry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    entry.add("frames [Hz]", frame_pace_.RateHz(SteadyNowS()));
    entry.add("frames dropped because newer ones waited", num_dropped_);
    entry.add("people", num_people_);
    entry.add("age of the mask [s]", mask_age_s_);
    entry.add("keypoints [Hz]", keypoint_pace_.RateHz(SteadyNowS()));
    entry.add("delay of keypoints [s]", keypoint_pace_.newest_delay_s());
    entry.summaryf(diagnostic_msgs::DiagnosticStatus::OK, "%d people", num_people_);
  }

  void Note(const RemovalResult& result) {
    const std::lock_guard<std::mutex> lock(mutex_);
    frame_pace_.Note(SteadyNowS());
    num_dropped_ = result.dropped;
    num_people_ = result.cut != nullptr ? result.cut->num_people : 0;
    mask_age_s_ = result.cut != nullptr ? result.cut->mask_age_s.value_or(-1) : -1;
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
    keypoint_pace_.Note(SteadyNowS(), delay_s);
  }
  KeypointPace CurrentPace() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {keypoint_pace_.RateHz(SteadyNowS()), keypoint_pace_.newest_delay_s()};
  }

  static constexpr double kErrorPeriodS = 5;
  static constexpr double kKeypointWindowS = 2;

  HumanRemovalNodeletConfig config_;  ///< at the start
  std::string skeletons_topic_;       ///< resolved
  std::optional<ClockCheck> clock_check_;
  std::optional<StampNs> keypoints_ns_;  ///< the newest since the newest frame
  StampNs image_ns_ = -1;                ///< of the newest frame
  TroubleLog trouble_{kErrorPeriodS,
                      [this](const std::string& text) { NODELET_ERROR_STREAM(text); },
                      [this](const std::string& text) { NODELET_INFO_STREAM(text); }};
  std::mutex mutex_;  ///< guards those below
  PaceMeter keypoint_pace_{kKeypointWindowS};
  PaceMeter frame_pace_;
  std::size_t num_dropped_ = 0;
  int num_people_ = 0;
  double mask_age_s_ = -1;  ///< of the newest frame; -1 without keypoints
  std::optional<TfTree> tf_tree_;
  std::optional<TfFeed> tf_feed_;         ///< empty without odometry
  std::optional<GravityFinder> gravity_;  ///< of the worker's thread
  std::unique_ptr<HumanRemovalPublishers> publishers_;
  std::unique_ptr<HumanRemovalWorker> worker_;  // ends before what it publishes with
  ros::Subscriber skeletons_;
  std::unique_ptr<ReconfigureServer<HumanRemovalNodeletConfig>> reconfigure_;
  ros::ServiceServer set_human_removal_;
  std::unique_ptr<RgbdSubscriber> blurred_;
  std::unique_ptr<RgbdSubscriber> subscriber_;  // no frame comes while the rest ends
  std::unique_ptr<Diagnostics> diagnostics_;
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::HumanRemovalNodelet, nodelet::Nodelet)
