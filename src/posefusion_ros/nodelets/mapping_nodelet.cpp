#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/mapping_input.h"
#include "posefusion_ros/nodelets/mapping_publishers.h"
#include "posefusion_ros/nodelets/mapping_status.h"
#include "posefusion_ros/nodelets/mapping_worker.h"
#include "posefusion_ros/parameter_reader.h"
#include "posefusion_ros/result_saver.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {

/// Tracks the camera against the map that it builds: frames under sharp/ in; tf, poses, map and
/// status out. The work is done in MappingWorker's thread, so the callbacks return at once.
class MappingNodelet : public CheckedNodelet {
 private:
  void Start() override {
    ros::NodeHandle node = getNodeHandle();
    const auto config = ReadConfig<MappingConfig>(getPrivateNodeHandle());
    output_dir_ = config.ros.output_dir;
    if (!output_dir_.empty()) {
      CheckOutputDir(output_dir_, getPrivateNodeHandle().resolveName("ros/output_dir"));
    }
    const RgbdTopics topics{node.resolveName(kSharpRgbTopic), node.resolveName(kSharpDepthTopic),
                            node.resolveName(kSharpInfoTopic)};
    const StaticTopics static_topics{node.resolveName(kStaticDepthTopic),
                                     node.resolveName(kStaticMaskTopic)};
    publishers_ = std::make_unique<MappingPublishers>(node, config);
    status_ = std::make_unique<MappingStatus>();
    worker_ = std::make_unique<MappingWorker>(config, topics, static_topics, MakeCallbacks());
    input_ = std::make_unique<MappingInput>(
        node, config.ros, [this](MappingMessages frame) { worker_->Push(std::move(frame)); },
        input_counts_);
    NODELET_INFO_STREAM("waiting for " << topics.rgb << ", " << topics.depth << ", " << topics.info
                                       << (config.ros.human_removal ? " and " + static_topics.depth
                                                                    : std::string()));
  }

  MappingWorker::Callbacks MakeCallbacks() {
    MappingWorker::Callbacks callbacks;
    callbacks.frame = [this](const Slam& slam, const FrameResult& result,
                             const std_msgs::Header& rgb_header, const MappingCounts& counts) {
      publishers_->PublishFrame(slam, result, rgb_header);
      publishers_->PublishStatus(status_->OfFrame(result, rgb_header, slam, WithInput(counts)));
    };
    callbacks.idle = [this](const Slam& slam, const MappingCounts& counts) {
      publishers_->PublishIdle(slam);
      if (const auto status = status_->OfIdle(WithInput(counts)))
        publishers_->PublishStatus(*status);
    };
    callbacks.reset = [this] { publishers_->Reset(); };
    callbacks.finish = [this](const Slam& slam) {
      if (!output_dir_.empty()) SaveResults(slam, output_dir_);
    };
    callbacks.log_error = [this](const std::string& text) { NODELET_ERROR_STREAM(text); };
    callbacks.log_info = [this](const std::string& text) { NODELET_WARN_STREAM(text); };
    return callbacks;
  }

  MappingCounts WithInput(MappingCounts counts) const {
    counts.held = input_counts_.held;
    counts.evicted = input_counts_.evicted;
    return counts;
  }

  MappingInputCounts input_counts_;
  std::string output_dir_;
  std::unique_ptr<MappingPublishers> publishers_;
  std::unique_ptr<MappingStatus> status_;
  std::unique_ptr<MappingWorker> worker_;
  std::unique_ptr<MappingInput> input_;  // last: stops feeding before the worker ends
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::MappingNodelet, nodelet::Nodelet)
