#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/nodelets/checked_nodelet.h"
#include "posefusion_ros/nodelets/mapping_publishers.h"
#include "posefusion_ros/nodelets/mapping_status.h"
#include "posefusion_ros/nodelets/mapping_worker.h"
#include "posefusion_ros/nodelets/rgbd_subscriber.h"
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
    const RgbdTopics topics{kSharpRgbTopic, kSharpDepthTopic, kSharpInfoTopic};
    const RgbdTopics names{node.resolveName(topics.rgb), node.resolveName(topics.depth),
                           node.resolveName(topics.info)};
    publishers_ = std::make_unique<MappingPublishers>(node, config);
    status_ = std::make_unique<MappingStatus>();
    worker_ = std::make_unique<MappingWorker>(config, names, MakeCallbacks());
    subscriber_ = std::make_unique<RgbdSubscriber>(
        node, topics, config.ros.input, config.ros.input_is_paired,
        [this](const RgbdMessages& frame) { worker_->Push(frame); });
    NODELET_INFO_STREAM("waiting for " << names.rgb << ", " << names.depth << ", " << names.info);
  }

  MappingWorker::Callbacks MakeCallbacks() {
    MappingWorker::Callbacks callbacks;
    callbacks.frame = [this](const Slam& slam, const FrameResult& result,
                             const std_msgs::Header& rgb_header, const MappingCounts& counts) {
      publishers_->PublishFrame(slam, result, rgb_header);
      publishers_->PublishStatus(status_->OfFrame(result, rgb_header, slam, counts));
    };
    callbacks.idle = [this](const Slam& slam, const MappingCounts& counts) {
      publishers_->PublishIdle(slam);
      if (const auto status = status_->OfIdle(counts)) publishers_->PublishStatus(*status);
    };
    callbacks.reset = [this] { publishers_->Reset(); };
    callbacks.finish = [this](const Slam& slam) {
      if (!output_dir_.empty()) SaveResults(slam, output_dir_);
    };
    callbacks.log_error = [this](const std::string& text) { NODELET_ERROR_STREAM(text); };
    callbacks.log_info = [this](const std::string& text) { NODELET_WARN_STREAM(text); };
    return callbacks;
  }

  std::string output_dir_;
  std::unique_ptr<MappingPublishers> publishers_;
  std::unique_ptr<MappingStatus> status_;
  std::unique_ptr<MappingWorker> worker_;
  std::unique_ptr<RgbdSubscriber> subscriber_;  // last: stops feeding before the worker ends
};

}  // namespace posefusion

PLUGINLIB_EXPORT_CLASS(posefusion::MappingNodelet, nodelet::Nodelet)
