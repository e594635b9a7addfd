#include "posefusion_ros/keypoint_inbox.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace posefusion {
namespace {

constexpr std::size_t kMaxWaiting = 300;
constexpr std::size_t kMaxArrivals = 300;
/// The latest frames by which is judged whether keypoints are timely.
constexpr int kNumJudged = 10;
constexpr double kTimelyShare = 0.75;

bool IsSameImage(StampNs a, StampNs b) { return std::abs(a - b) < kSameImageNs; }

}  // namespace

void KeypointInbox::AddKeypoints(Skeletons skeletons, Clock::time_point now) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (Arrival& arrival : arrivals_) {
      if (!IsSameImage(arrival.image_ns, skeletons.stamp_ns)) continue;
      if (!arrival.keypoints) arrival.keypoints = now;
      have_come_ = true;
    }
    waiting_.push_back(std::move(skeletons));
    if (waiting_.size() > kMaxWaiting) waiting_.pop_front();
  }
  changed_.notify_all();
}

void KeypointInbox::NoteFrame(StampNs image_ns, Clock::time_point now) {
  Note({image_ns, now, std::nullopt, false});
}

void KeypointInbox::NoteBlurredFrame(StampNs image_ns, Clock::time_point now) {
  Note({image_ns, now, std::nullopt, true});
}

void KeypointInbox::Note(Arrival arrival) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (HasKeypointsOf(arrival.image_ns)) {
      arrival.keypoints = arrival.frame;
      have_come_ = true;
    }
    arrivals_.push_back(arrival);
    if (arrivals_.size() > kMaxArrivals) arrivals_.pop_front();
  }
  changed_.notify_all();
}

bool KeypointInbox::AreTimely(Clock::duration grace, Clock::time_point now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  int judged = 0;
  int timely = 0;
  for (auto it = arrivals_.rbegin(); it != arrivals_.rend() && judged < kNumJudged; ++it) {
    if (it->is_blurred) continue;
    const bool is_timely = it->keypoints && *it->keypoints - it->frame <= grace;
    if (!is_timely && now - it->frame <= grace) continue;  // they may still come
    ++judged;
    if (is_timely) ++timely;
  }
  return timely >= kTimelyShare * judged;
}

bool KeypointInbox::WaitForFirst(StampNs until_ns, Clock::duration silence) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto is_over = [&] {
    return closed_ || have_come_ || (!arrivals_.empty() && arrivals_.back().image_ns >= until_ns);
  };
  auto status = std::cv_status::no_timeout;
  while (!is_over() && status == std::cv_status::no_timeout) {
    status = changed_.wait_for(lock, silence);
  }
  return have_come_;
}

std::vector<Skeletons> KeypointInbox::Take(StampNs image_ns, Clock::time_point deadline) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return closed_ || HasKeypointsOf(image_ns); });
  std::vector<Skeletons> taken;
  std::deque<Skeletons> later;
  for (Skeletons& skeletons : waiting_) {
    SnapToFrame(skeletons);
    if (skeletons.stamp_ns <= image_ns) {
      taken.push_back(std::move(skeletons));
    } else {
      later.push_back(std::move(skeletons));
    }
  }
  waiting_.swap(later);
  return taken;
}

void KeypointInbox::Restart(StampNs image_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto is_later = [&](StampNs stamp_ns) { return stamp_ns >= image_ns + kSameImageNs; };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                [&](const Skeletons& s) { return is_later(s.stamp_ns); }),
                 waiting_.end());
  const auto is_this = [&](const Arrival& arrival) { return arrival.image_ns == image_ns; };
  const auto newest = std::find_if(arrivals_.rbegin(), arrivals_.rend(), is_this);
  const auto first = newest == arrivals_.rend() ? arrivals_.end() : std::prev(newest.base());
  arrivals_.erase(arrivals_.begin(), first);
  have_come_ = std::any_of(arrivals_.begin(), arrivals_.end(), [&](const Arrival& arrival) {
    return HasKeypointsOf(arrival.image_ns);
  });
}

void KeypointInbox::Close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void KeypointInbox::SnapToFrame(Skeletons& skeletons) const {
  for (const Arrival& arrival : arrivals_) {
    if (IsSameImage(arrival.image_ns, skeletons.stamp_ns)) skeletons.stamp_ns = arrival.image_ns;
  }
}

bool KeypointInbox::HasKeypointsOf(StampNs image_ns) const {
  return std::any_of(waiting_.begin(), waiting_.end(),
                     [&](const Skeletons& s) { return IsSameImage(s.stamp_ns, image_ns); });
}

}  // namespace posefusion
