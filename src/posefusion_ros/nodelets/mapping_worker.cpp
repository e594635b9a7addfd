#include "posefusion_ros/nodelets/mapping_worker.h"

#include <exception>
#include <utility>

#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

constexpr double kLogPeriodS = 5;
constexpr std::chrono::milliseconds kIdlePeriod(100);

std::size_t QueueCapacity(const MappingRosConfig& config) {
  return config.input.lossless ? 0 : static_cast<std::size_t>(config.queue_size);
}

/// HumanRemoval took people out of the frame.
bool HasPeopleRemoved(const MappingMessages& messages) {
  return messages.human_info && messages.human_info->removal_enabled;
}

}  // namespace

MappingWorker::MappingWorker(const MappingConfig& config, const CameraInfoConfig& camera_info,
                             RgbdTopics topics, StaticTopics static_topics, Callbacks callbacks)
    : config_(config.ros),
      camera_info_(camera_info),
      topics_(std::move(topics)),
      static_topics_(std::move(static_topics)),
      callbacks_(std::move(callbacks)),
      slam_(config.slam, config.ros.num_threads),
      trouble_(kLogPeriodS, callbacks_.log_error, callbacks_.log_info),
      queue_(QueueCapacity(config.ros)) {
  thread_ = std::thread([this] { Run(); });
}

MappingWorker::~MappingWorker() {
  queue_.Close();
  thread_.join();
}

void MappingWorker::Run() {
  while (!queue_.closed()) {
    const auto messages = queue_.PopFor(kIdlePeriod);
    RunSteps();
    bool worked = false;
    Guarded([&] { worked = messages && !paused_ && Work(*messages); });
    if (!worked) Guarded([&] { callbacks_.idle(slam_, CurrentCounts()); });
  }
  Guarded([&] { callbacks_.finish(slam_); });
}

bool MappingWorker::Between(const std::function<void(Slam&)>& step, double timeout_s) {
  // Whoever claims it first decides: the worker does the step, or the caller gives it up.
  const auto claimed = std::make_shared<std::atomic<bool>>(false);
  std::packaged_task<void()> task([this, step, claimed] {
    if (!claimed->exchange(true)) step(slam_);
  });
  std::future<void> done = task.get_future();
  {
    const std::lock_guard<std::mutex> lock(steps_mutex_);
    steps_.push_back(std::move(task));
  }
  const auto status = done.wait_for(std::chrono::duration<double>(timeout_s));
  if (status != std::future_status::ready && !claimed->exchange(true)) return false;
  done.get();
  return true;
}

void MappingWorker::RunSteps() {
  std::deque<std::packaged_task<void()>> steps;
  {
    const std::lock_guard<std::mutex> lock(steps_mutex_);
    steps.swap(steps_);
  }
  for (auto& step : steps) step();
}

void MappingWorker::Guarded(const std::function<void()>& step) {
  try {
    step();
  } catch (const std::exception& error) {
    Refuse(error.what());
  }
}

RgbdFrame MappingWorker::ToFrame(const MappingMessages& messages) const {
  if (!HasPeopleRemoved(messages)) {
    return ToRgbdFrame(messages.rgbd, camera_info_.images_are_rectified, topics_);
  }
  return ToRgbdFrame({messages.rgbd.rgb, messages.static_depth, messages.rgbd.info},
                     camera_info_.images_are_rectified,
                     {topics_.rgb, static_topics_.depth, topics_.info});
}

PeopleInFrame MappingWorker::ToPeople(const MappingMessages& messages) const {
  if (!HasPeopleRemoved(messages)) return {};
  return {ToMask(messages.mask, static_topics_.mask), ToDepthM(messages.rgbd.depth, topics_.depth)};
}

bool MappingWorker::Work(const MappingMessages& messages) {
  const RgbdFrame frame = ToFrame(messages);
  const PeopleInFrame people = ToPeople(messages);
  if (!IsInOrder(frame.stamp_ns)) return false;
  PrepareStart(messages.rgbd.rgb->header);
  FrameResult result;
  try {
    result = slam_.ProcessFrame(frame, people, {callbacks_.odometry(messages.rgbd.rgb->header)});
  } catch (const std::invalid_argument& error) {
    Refuse(topics_.rgb + ", " + topics_.depth + ", " + topics_.info + ": " + error.what());
    return false;
  }
  last_stamp_ns_ = frame.stamp_ns;
  Count(result);
  counts_.human_info = messages.human_info;
  trouble_.AllWell();
  callbacks_.frame(slam_, result, messages.rgbd.rgb->header, CurrentCounts());
  return true;
}

bool MappingWorker::IsInOrder(StampNs stamp_ns) {
  if (stamp_ns > last_stamp_ns_) return true;
  const double back_s = SecondsBetween(stamp_ns, last_stamp_ns_);
  if (back_s < config_.reset_after_jump_back_s) {
    Refuse(topics_.rgb + ": stamp " + FormatStamp(stamp_ns) + " is not after the one before");
    return false;
  }
  callbacks_.log_info("time went back by " + std::to_string(back_s) +
                      " s (a bag restarted?): " + "map and poses start anew");
  Reset();
  return true;
}

void MappingWorker::Reset() {
  slam_.Reset();
  const std::size_t resets = counts_.resets + 1;
  counts_ = {};
  counts_.resets = resets;
  last_stamp_ns_ = -1;
  had_pose_ = false;
  callbacks_.reset();
}

void MappingWorker::PrepareStart(const std_msgs::Header& rgb_header) {
  if (slam_.NumSurfels() == 0) slam_.SetStartPose(callbacks_.start_pose(rgb_header));
}

MappingCounts MappingWorker::CurrentCounts() const {
  MappingCounts counts = counts_;
  counts.dropped = queue_.num_dropped();
  counts.queue_length = queue_.size();
  counts.paused = paused_;
  counts.trouble = trouble_.trouble();
  return counts;
}

void MappingWorker::Count(const FrameResult& result) {
  ++counts_.processed;
  if (result.HasPose()) ++counts_.tracked;
  if (had_pose_ && !result.HasPose()) ++counts_.times_lost;
  if (result.relocalised) ++counts_.times_found;
  had_pose_ = result.HasPose();
}

void MappingWorker::Refuse(const std::string& text) {
  ++counts_.refused;
  trouble_.Report(text, SteadyNowS());
}

}  // namespace posefusion
