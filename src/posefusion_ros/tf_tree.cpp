#include "posefusion_ros/tf_tree.h"

#include <tf2/exceptions.h>

#include <algorithm>

#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

/// Frames of a bag that is played without loss may wait for long.
constexpr double kKeptS = 120;

Eigen::Isometry3d ToIsometry(const geometry_msgs::Transform& transform) {
  Eigen::Isometry3d T(Eigen::Translation3d(transform.translation.x, transform.translation.y,
                                           transform.translation.z));
  const auto& q = transform.rotation;
  T.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  return T;
}

}  // namespace

std::string TfName(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

TfTree::TfTree(double jump_back_s) : jump_back_s_(jump_back_s), buffer_(ros::Duration(kKeptS)) {}

void TfTree::Add(const geometry_msgs::TransformStamped& transform, const std::string& publisher,
                 bool is_static) {
  geometry_msgs::TransformStamped named = transform;
  named.header.frame_id = TfName(transform.header.frame_id);
  named.child_frame_id = TfName(transform.child_frame_id);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time& stamp = transform.header.stamp;
    const auto found = known_.find(named.child_frame_id);
    const bool went_back = !is_static && found != known_.end() && !found->second.is_static &&
                           found->second.newest > stamp &&
                           (found->second.newest - stamp).toSec() > jump_back_s_;
    if (went_back) ClearLocked();
    if (!buffer_.setTransform(named, publisher, is_static)) return;  // broken or too old
    Known& known = known_[named.child_frame_id];
    known.link = {named.header.frame_id, publisher};
    known.is_static = is_static;
    known.newest = std::max(known.newest, stamp);
  }
  changed_.notify_all();
}

std::optional<Eigen::Isometry3d> TfTree::Find(const std::string& target, const std::string& source,
                                              StampNs stamp_ns) const {
  if (TfName(target) == TfName(source)) return Eigen::Isometry3d::Identity();
  try {
    return ToIsometry(
        buffer_.lookupTransform(TfName(target), TfName(source), ToRosTime(stamp_ns)).transform);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::optional<Eigen::Isometry3d> TfTree::WaitFor(const std::string& target,
                                                 const std::string& source, StampNs stamp_ns,
                                                 double timeout_s) const {
  std::optional<Eigen::Isometry3d> found;
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(timeout_s), [&] {
    found = Find(target, source, stamp_ns);
    return found.has_value();
  });
  return found;
}

std::string TfTree::WhyNot(const std::string& target, const std::string& source,
                           StampNs stamp_ns) const {
  if (TfName(target) == TfName(source)) return "";
  try {
    buffer_.lookupTransform(TfName(target), TfName(source), ToRosTime(stamp_ns));
    return "";
  } catch (const tf2::ExtrapolationException&) {
    return "it is known at other times only (late, too slow or stopped)";
  } catch (const tf2::ConnectivityException&) {
    return "both are known but nothing connects them";
  } catch (const std::exception&) {
    return LinkOf(source) || LinkOf(target) ? "one of them is unknown, or there is a loop"
                                            : "nobody publishes them";
  }
}

std::optional<TfTree::Link> TfTree::LinkOf(const std::string& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = known_.find(TfName(frame));
  if (found == known_.end()) return std::nullopt;
  return found->second.link;
}

std::vector<std::string> TfTree::ChainOf(const std::string& frame) const {
  std::vector<std::string> chain = {TfName(frame)};
  while (const auto link = LinkOf(chain.back())) {
    if (std::find(chain.begin(), chain.end(), link->parent) != chain.end()) break;
    chain.push_back(link->parent);
  }
  return chain;
}

void TfTree::Clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ClearLocked();
}

/// tf2 keeps static frames.
void TfTree::ClearLocked() {
  buffer_.clear();
  for (auto it = known_.begin(); it != known_.end();) {
    it = it->second.is_static ? std::next(it) : known_.erase(it);
  }
}

}  // namespace posefusion
