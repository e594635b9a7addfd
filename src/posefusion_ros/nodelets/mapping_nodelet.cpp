#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/mapping_diagnostics.h"
#include "posefusion_ros/nodelets/mapping_input.h"
#include "posefusion_ros/nodelets/mapping_publishers.h"
#include "posefusion_ros/nodelets/mapping_services.h"
#include "posefusion_ros/nodelets/mapping_status.h"
#include "posefusion_ros/nodelets/mapping_worker.h"
#include "posefusion_ros/nodelets/robot_publishers.h"
#include "posefusion_ros/nodelets/service_thread.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/reconfigure_server.h"
#include "posefusion_ros/result_saver.h"
#include "posefusion_ros/tf_bridge.h"
#include "posefusion_ros/topic_names.h"
#include "posefusion_ros/visual_odometry.h"

namespace posefusion {

/// Tracks the camera against the map that it builds: frames under sharp/ in; tf, poses, map and
/// status out. The work is done in MappingWorker's thread, so the callbacks return at once.
class MappingNodelet : public CheckedNodelet {
 private:
  void Start() override {
    ros::NodeHandle node = getNodeHandle();
    config_ = ReadConfig<MappingConfig>(getPrivateNodeHandle());
    const std::string& output_dir = config_.ros.output_dir;
    if (!output_dir.empty()) {
      CheckOutputDir(output_dir, getPrivateNodeHandle().resolveName("ros/output_dir"));
    }
    const RgbdTopics topics{node.resolveName(kSharpRgbTopic), node.resolveName(kSharpDepthTopic),
                            node.resolveName(kSharpInfoTopic)};
    const StaticTopics static_topics{node.resolveName(kStaticDepthTopic),
                                     node.resolveName(kStaticMaskTopic)};
    robot_publishers_ = std::make_unique<RobotPublishers>(node, config_.frames);
    tf_bridge_ = std::make_unique<TfBridge>(node, config_.frames, config_.ros.tf, config_.ros.start,
                                            config_.ros.reset_after_jump_back_s, TfCallbacks());
    publishers_ = std::make_unique<MappingPublishers>(node, config_);
    status_ = std::make_unique<MappingStatus>();
    worker_ = std::make_unique<MappingWorker>(config_, ReadCameraInfoConfig(node), topics,
                                              static_topics, MakeCallbacks());
    services_ = std::make_unique<MappingServices>(service_thread_.Handle(getPrivateNodeHandle()),
                                                  output_dir, *worker_);
    StartReconfigure();
    input_ = std::make_unique<MappingInput>(
        node, config_.ros, [this](MappingMessages frame) { worker_->Push(std::move(frame)); },
        input_counts_);
    StartDiagnostics(node);
    NODELET_INFO_STREAM("waiting for " << topics.rgb << ", " << topics.depth << ", " << topics.info
                                       << (config_.ros.human_removal ? " and " + static_topics.depth
                                                                     : std::string()));
  }

  TfBridge::Callbacks TfCallbacks() {
    TfBridge::Callbacks callbacks;
    callbacks.located = [this](const LocatedPose& located) { robot_publishers_->Publish(located); };
    callbacks.log_error = [this](const std::string& text) { NODELET_ERROR_STREAM(text); };
    callbacks.log_info = [this](const std::string& text) { NODELET_INFO_STREAM(text); };
    return callbacks;
  }

  MappingWorker::Callbacks MakeCallbacks() {
    MappingWorker::Callbacks callbacks;
    callbacks.start_pose = [this](const std_msgs::Header& rgb_header) {
      return tf_bridge_->FindStartPose(ToStampNs(rgb_header.stamp), rgb_header.frame_id);
    };
    callbacks.odometry = [this](const std_msgs::Header& rgb_header) {
      return tf_bridge_->OdomToCamera(ToStampNs(rgb_header.stamp), rgb_header.frame_id);
    };
    callbacks.frame = [this](const Slam& slam, const FrameResult& result,
                             const std_msgs::Header& rgb_header, const MappingCounts& counts) {
      OnResult(slam, result, rgb_header, WithInput(counts));
    };
    callbacks.idle = [this](const Slam& slam, const MappingCounts& counts) {
      publishers_->PublishIdle(slam);
      if (const auto status = status_->OfIdle(WithInput(counts))) Publish(*status);
    };
    callbacks.reset = [this] {
      visual_odometry_.Reset();
      tf_bridge_->Reset();
      publishers_->Reset();
    };
    callbacks.finish = [this](const Slam& slam) {
      if (!config_.ros.output_dir.empty()) SaveResults(slam, config_.ros.output_dir);
    };
    callbacks.log_error = [this](const std::string& text) { NODELET_ERROR_STREAM(text); };
    callbacks.log_info = [this](const std::string& text) { NODELET_WARN_STREAM(text); };
    return callbacks;
  }

  /// The robot first, people after it.
  void OnResult(const Slam& slam, const FrameResult& result, const std_msgs::Header& rgb_header,
                const MappingCounts& counts) {
    if (result.HasPose()) {
      tf_bridge_->Offer(visual_odometry_.Advance(result, slam.trajectory(), rgb_header));
    } else {
      visual_odometry_.NoteLost();
    }
    Publish(status_->OfFrame(result, rgb_header, slam, counts, tf_bridge_->trouble()));
    publishers_->PublishFrame(slam, result, rgb_header);
  }

  void Publish(const Status& status) {
    publishers_->PublishStatus(status);
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_status_ = status;
  }

  void StartReconfigure() {
    const auto apply = [this](const MappingConfig& config) {
      if (!worker_->Between([&](Slam& slam) { slam.Adopt(config.slam); })) {
        throw std::runtime_error("the mapping is too busy or ends");
      }
    };
    reconfigure_ = std::make_unique<ReconfigureServer<MappingConfig>>(
        service_thread_.Handle(getPrivateNodeHandle()), config_,
        std::vector<std::string>{"pyramid.min_depth_m", "pyramid.max_depth_m",
                                 "export_min_confidence"},
        apply, [this](const std::string& text) { NODELET_ERROR_STREAM(text); });
  }

  void StartDiagnostics(const ros::NodeHandle& node) {
    diagnostics_ = std::make_unique<Diagnostics>(node, getPrivateNodeHandle(), getName());
    diagnostics_->Add("topics", [this](Diagnostics::Wrapper& entry) {
      DescribeTopics(input_->TopicStates(), config_.ros.input.no_data_warning_s, entry);
    });
    const auto add = [this](const char* task,
                            void (*describe)(const Status&, Diagnostics::Wrapper&)) {
      diagnostics_->Add(task, [this, describe](Diagnostics::Wrapper& entry) {
        const std::lock_guard<std::mutex> lock(mutex_);
        describe(newest_status_, entry);
      });
    };
    add("frames", DescribeFrames);
    add("tracking", DescribeTracking);
    add("tf", DescribeTf);
    add("people", DescribePeople);
    add("stages", DescribeStages);
  }

  MappingCounts WithInput(MappingCounts counts) const {
    counts.held = input_counts_.held;
    counts.evicted = input_counts_.evicted;
    return counts;
  }

  MappingConfig config_;
  MappingInputCounts input_counts_;
  VisualOdometry visual_odometry_;
  std::mutex mutex_;  ///< guards the one below
  Status newest_status_;
  std::unique_ptr<RobotPublishers> robot_publishers_;
  std::unique_ptr<TfBridge> tf_bridge_;
  std::unique_ptr<MappingPublishers> publishers_;
  std::unique_ptr<MappingStatus> status_;
  std::unique_ptr<MappingWorker> worker_;
  ServiceThread service_thread_;
  std::unique_ptr<MappingServices> services_;
  std::unique_ptr<ReconfigureServer<MappingConfig>> reconfigure_;
  std::unique_ptr<MappingInput> input_;  // stops feeding before the worker ends
  std::unique_ptr<Diagnostics> diagnostics_;
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::MappingNodelet, nodelet::Nodelet)
