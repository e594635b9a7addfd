#include "posefusion_ros/static_frame_buffer.h"

#include <algorithm>
#include <utility>

#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

/// Messages that may wait for a frame: those of frames that were evicted come to nothing.
constexpr std::size_t kMaxUnclaimed = 60;

template <class MessagePtr>
void Append(std::deque<MessagePtr>& messages, const MessagePtr& message) {
  messages.push_back(message);
  if (messages.size() > kMaxUnclaimed) messages.pop_front();
}

/// Moves the message of that stamp to `place`, unless there is one already.
template <class MessagePtr>
void Claim(std::deque<MessagePtr>& messages, const ros::Time& stamp, MessagePtr& place) {
  if (place) return;
  const auto it = std::find_if(messages.begin(), messages.end(), [&](const MessagePtr& message) {
    return message->header.stamp == stamp;
  });
  if (it == messages.end()) return;
  place = std::move(*it);
  messages.erase(it);
}

bool IsComplete(const MappingMessages& frame) {
  return frame.static_depth && frame.mask && frame.human_info;
}

}  // namespace

std::vector<MappingMessages> StaticFrameBuffer::AddFrame(const RgbdMessages& frame) {
  const StampNs stamp_ns = ToStampNs(frame.rgb->header.stamp);
  if (!held_.empty() && stamp_ns < held_.rbegin()->first) held_.clear();
  held_[stamp_ns].rgbd = frame;
  return Release();
}

std::vector<MappingMessages> StaticFrameBuffer::AddDepth(const sensor_msgs::ImageConstPtr& depth) {
  Append(depths_, depth);
  return Release();
}

std::vector<MappingMessages> StaticFrameBuffer::AddMask(const sensor_msgs::ImageConstPtr& mask) {
  Append(masks_, mask);
  return Release();
}

std::vector<MappingMessages> StaticFrameBuffer::AddInfo(const HumanInfoConstPtr& info) {
  Append(infos_, info);
  return Release();
}

std::vector<MappingMessages> StaticFrameBuffer::Release() {
  ClaimMessages();
  std::vector<MappingMessages> released;
  // Infos come in stamp order: a frame without one before a frame with one was left out.
  for (std::size_t left = NumUpToLastInfo(); left > 0; --left) {
    const auto first = held_.begin();
    if (IsComplete(first->second)) {
      released.push_back(std::move(first->second));
    } else if (first->second.human_info) {
      break;  // its images are on the way
    } else {
      ++num_evicted_;
    }
    held_.erase(first);
  }
  EvictOld();
  return released;
}

void StaticFrameBuffer::ClaimMessages() {
  for (auto& [stamp_ns, frame] : held_) {
    Claim(depths_, frame.rgbd.depth->header.stamp, frame.static_depth);
    Claim(masks_, frame.rgbd.rgb->header.stamp, frame.mask);
    Claim(infos_, frame.rgbd.rgb->header.stamp, frame.human_info);
  }
}

std::size_t StaticFrameBuffer::NumUpToLastInfo() const {
  std::size_t index = 0;
  std::size_t up_to = 0;
  for (const auto& [stamp_ns, frame] : held_) {
    ++index;
    if (frame.human_info) up_to = index;
  }
  return up_to;
}

void StaticFrameBuffer::EvictOld() {
  if (hold_s_ <= 0) return;
  while (!held_.empty() && SecondsBetween(held_.begin()->first, held_.rbegin()->first) > hold_s_) {
    held_.erase(held_.begin());
    ++num_evicted_;
  }
}

}  // namespace posefusion
