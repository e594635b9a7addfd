#include "posefusion_ros/bag_skeletons.h"

#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "posefusion/skeleton/nearest_stamp.h"
#include "posefusion/skeleton/skeleton_checks.h"
#include "posefusion_ros/bag_reading.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/skeleton_conversions.h"

namespace posefusion {
namespace {

constexpr const char* kType = "posefusion/Skeletons";

/// When keypoints were known, by the clock of the images.
StampNs ArrivalOf(StampNs stamp_ns, StampNs recorded_ns) {
  const bool same_clock = std::abs(SecondsBetween(stamp_ns, recorded_ns)) <= kMaxClockDifferenceS;
  return same_clock ? std::max(stamp_ns, recorded_ns) : stamp_ns;
}

}  // namespace

BagSkeletons::BagSkeletons(const std::string& path, const std::string& topic)
    : topic_(AbsoluteTopic(topic)), clock_check_(topic_) {
  rosbag::Bag bag;
  OpenBag(bag, path);
  CountMessages(bag, path, topic_, kType);
  rosbag::View view(bag, rosbag::TopicQuery(topic_));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = ReadMessage<SkeletonsMessage>(instance);
    const StampNs stamp_ns = ToStampNs(message->header.stamp);
    recorded_[stamp_ns] = {message, ArrivalOf(stamp_ns, ToStampNs(instance.getTime()))};
  }
}

void BagSkeletons::Offer(const RgbdFrame& frame) {
  const auto found = FindStamp(recorded_, frame.stamp_ns, kSameImageNs);
  if (found == recorded_.end()) return CheckClock(frame);
  used_.insert(found->first);
  Skeletons skeletons = ToSkeletons(*found->second.message, topic_).skeletons;
  skeletons.stamp_ns = frame.stamp_ns;
  skeletons.arrival_ns = found->second.arrival_ns;
  DropUnusable(skeletons.people, frame.camera.width, frame.camera.height);
  waiting_.Add(std::move(skeletons));
}

/// Messages may be few, so only those that have never fitted are suspected.
void BagSkeletons::CheckClock(const RgbdFrame& frame) {
  if (!used_.empty()) return;
  const StampNs nearest_ns = NearestStamp(recorded_, frame.stamp_ns)->first;
  if (auto note = clock_check_.Compare(nearest_ns, frame.stamp_ns)) {
    notes_.push_back(std::move(*note));
  }
}

std::vector<std::string> BagSkeletons::TakeNotes() { return std::exchange(notes_, {}); }

SkeletonCounts BagSkeletons::counts() const {
  return {static_cast<int>(used_.size()), static_cast<int>(recorded_.size() - used_.size())};
}

bool HasSkeletons(const std::string& path, const std::string& topic) {
  rosbag::Bag bag;
  OpenBag(bag, path);
  const auto topics = TopicsOfType(bag, kType);
  return std::find(topics.begin(), topics.end(), AbsoluteTopic(topic)) != topics.end();
}

}  // namespace posefusion
