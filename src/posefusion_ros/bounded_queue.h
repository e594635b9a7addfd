#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace posefusion {

/// Hands items from one thread to another. When it is full the oldest item makes room: a robot
/// wants the newest frame. Thread-safe.
template <class T>
class BoundedQueue {
 public:
  /// `capacity` 0 means no bound.
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  void Push(T item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      while (!HasRoom()) {
        if (entries_.front().counts) ++num_dropped_;
        entries_.pop_front();
      }
      entries_.push_back({std::move(item), true});
    }
    changed_.notify_one();
  }

  /// Leaves the item out when it is full, and drops it without counting it.
  void PushIfRoom(T item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_ || !HasRoom()) return;
      entries_.push_back({std::move(item), false});
    }
    changed_.notify_one();
  }

  /// For what is pushed from now on; nothing is dropped by this.
  void SetCapacity(std::size_t capacity) {
    const std::lock_guard<std::mutex> lock(mutex_);
    capacity_ = capacity;
  }

  /// A step back to a smaller capacity: what waits now may stay, and each call makes room for one
  /// item less, down to `least`. No effect without a bound.
  void ShrinkCapacity(std::size_t least) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (capacity_ > least) capacity_ = std::max(least, std::min(capacity_ - 1, entries_.size()));
  }

  /// The oldest item; nothing after `timeout` without one, and at once after Close.
  std::optional<T> PopFor(std::chrono::milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return closed_ || !entries_.empty(); });
    if (closed_ || entries_.empty()) return std::nullopt;
    std::optional<T> item(std::move(entries_.front().item));
    entries_.pop_front();
    return item;
  }

  /// Ends all waiting; what is in the queue is forgotten.
  void Close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
      entries_.clear();
    }
    changed_.notify_all();
  }

  bool closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return entries_.size();
  }
  /// Items that have been dropped to make room.
  std::size_t num_dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return num_dropped_;
  }

 private:
  struct Entry {
    T item;
    bool counts;  ///< as dropped
  };
  bool HasRoom() const { return capacity_ == 0 || entries_.size() < capacity_; }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t capacity_;
  std::deque<Entry> entries_;
  std::size_t num_dropped_ = 0;
  bool closed_ = false;
};

}  // namespace posefusion
