#include "posefusion_ros/nodelets/cloud_publisher.h"

#include <sensor_msgs/PointCloud2.h>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {
namespace {

constexpr std::chrono::milliseconds kWait(200);

}  // namespace

CloudPublisher::CloudPublisher(ros::NodeHandle& node, const std::string& topic, double period_s)
    : period_s_(period_s),
      publisher_(node.advertise<sensor_msgs::PointCloud2>(topic, 1, true)),
      last_s_(SteadyNowS() - period_s),
      thread_([this] { Run(); }) {}

CloudPublisher::~CloudPublisher() {
  jobs_.Close();
  thread_.join();
}

void CloudPublisher::Offer(const Slam& slam, const std_msgs::Header& header) {
  const double now_s = SteadyNowS();
  if (!changed_ || now_s - last_s_ < period_s_ || publisher_.getNumSubscribers() == 0) return;
  changed_ = false;
  last_s_ = now_s;
  jobs_.Push({slam.ExportMap(slam.config().export_min_confidence), header});
}

void CloudPublisher::Run() {
  while (!jobs_.closed()) {
    if (const auto job = jobs_.PopFor(kWait))
      publisher_.publish(ToPointCloud2(job->cloud, job->header));
  }
}

}  // namespace posefusion
