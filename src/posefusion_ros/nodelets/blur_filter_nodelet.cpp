#include <posefusion/BlurScore.h>

#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "posefusion/image/blur_filter.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/nodelets/blur_filter_config.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/diagnostics.h"
#include "posefusion_ros/nodelets/rgbd_subscriber.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/reconfigure_server.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

/// The topics that frames go out on.
class FramePublisher {
 public:
  FramePublisher() = default;
  FramePublisher(ros::NodeHandle& node, const RgbdTopics& topics, std::uint32_t queue_size)
      : rgb_(node.advertise<sensor_msgs::Image>(topics.rgb, queue_size)),
        depth_(node.advertise<sensor_msgs::Image>(topics.depth, queue_size)),
        info_(node.advertise<sensor_msgs::CameraInfo>(topics.info, queue_size)) {}

  void Publish(const RgbdMessages& frame) const {
    if (frame.info) info_.publish(frame.info);
    depth_.publish(frame.depth);
    rgb_.publish(frame.rgb);
  }

 private:
  ros::Publisher rgb_;
  ros::Publisher depth_;
  ros::Publisher info_;
};

}  // namespace

/// Divides the frames of an RGB-D camera into those that are not blurred, under sharp/, and the
/// others, under blurred/. What goes out are the messages that came in, not copies: camera_info
/// first, then depth, then colour, so that whoever has the colour image has the rest.
class BlurFilterNodelet : public CheckedNodelet {
 private:
  void Start() override {
    ros::NodeHandle node = getNodeHandle();
    config_ = ReadConfig<BlurFilterNodeletConfig>(getPrivateNodeHandle());
    filter_.emplace(config_.filter);
    const auto queue_size = static_cast<std::uint32_t>(
        config_.ros.input.lossless ? 0 : config_.ros.input.subscriber_queue_size);
    sharp_ = {node, {kSharpRgbTopic, kSharpDepthTopic, kSharpInfoTopic}, queue_size};
    blurred_ = {node, {kBlurredRgbTopic, kBlurredDepthTopic, kBlurredInfoTopic}, queue_size};
    score_ = node.advertise<BlurScore>(kBlurScoreTopic, queue_size);
    rgb_topic_ = node.resolveName(kCameraRgbTopic);
    subscriber_ = std::make_unique<RgbdSubscriber>(
        node, RgbdTopics{kCameraRgbTopic, kCameraDepthTopic, kCameraInfoTopic}, config_.ros.input,
        config_.ros.input_is_paired, [this](const RgbdMessages& frame) { OnFrame(frame); });
    StartReconfigure();
    StartDiagnostics(node);
    NODELET_INFO_STREAM("filter " << (config_.filter.enabled ? "on" : "off") << ", waiting for "
                                  << subscriber_->topics().rgb << ", "
                                  << subscriber_->topics().depth << ", "
                                  << subscriber_->topics().info);
  }

  void StartReconfigure() {
    const auto apply = [this](const BlurFilterNodeletConfig& config) {
      filter_.emplace(config.filter);
      config_.filter = config.filter;
    };
    reconfigure_ = std::make_unique<ReconfigureServer<BlurFilterNodeletConfig>>(
        getPrivateNodeHandle(), config_,
        std::vector<std::string>{"enabled", "mode", "threshold", "max_length_px", "enough_detail",
                                 "exposure_s"},
        apply, [this](const std::string& text) { NODELET_ERROR_STREAM(text); });
  }

  void StartDiagnostics(const ros::NodeHandle& node) {
    diagnostics_ = std::make_unique<Diagnostics>(node, getPrivateNodeHandle(), getName());
    diagnostics_->Add("topics", [this](Diagnostics::Wrapper& entry) {
      DescribeTopics(subscriber_->TopicStates(), config_.ros.input.no_data_warning_s, entry);
    });
    diagnostics_->Add("blur", [this](Diagnostics::Wrapper& entry) {
      entry.add("frames seen", filter_->counts().seen);
      entry.add("frames dropped", filter_->counts().dropped);
      entry.summary(diagnostic_msgs::DiagnosticStatus::OK,
                    config_.filter.enabled ? "blurred frames are left out" : "off");
    });
  }

  void OnFrame(const RgbdMessages& frame) {
    try {
      const bool sharp =
          !config_.filter.enabled || IsSharp(*frame.rgb, ToRgb(frame.rgb, rgb_topic_));
      trouble_.AllWell();
      (sharp ? sharp_ : blurred_).Publish(frame);
    } catch (const std::exception& error) {
      trouble_.Report(error.what(), SteadyNowS());
    }
  }

  bool IsSharp(const sensor_msgs::Image& message, const cv::Mat& rgb) {
    if (message.header.stamp < last_stamp_) filter_.emplace(config_.filter);  // a bag restarted
    last_stamp_ = message.header.stamp;
    const BlurDecision decision = filter_->Judge(rgb, ToStampNs(message.header.stamp));
    BlurScore score;
    score.header = message.header;
    score.score = decision.score;
    score.threshold = decision.threshold;
    score.kept = static_cast<std::uint8_t>(decision.keep);
    score.reason = ToString(decision.reason);
    score.frames_seen = static_cast<std::uint64_t>(filter_->counts().seen);
    score.frames_dropped = static_cast<std::uint64_t>(filter_->counts().dropped);
    score_.publish(score);
    return decision.keep;
  }

  BlurFilterNodeletConfig config_;
  std::optional<BlurFilter> filter_;
  ros::Time last_stamp_;
  std::string rgb_topic_;  ///< resolved
  TroubleLog trouble_{5, [this](const std::string& text) { NODELET_ERROR_STREAM(text); },
                      [this](const std::string& text) { NODELET_INFO_STREAM(text); }};
  FramePublisher sharp_;
  FramePublisher blurred_;
  ros::Publisher score_;
  std::unique_ptr<ReconfigureServer<BlurFilterNodeletConfig>> reconfigure_;
  std::unique_ptr<RgbdSubscriber> subscriber_;  // no frame comes while the rest ends
  std::unique_ptr<Diagnostics> diagnostics_;
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::BlurFilterNodelet, nodelet::Nodelet)
