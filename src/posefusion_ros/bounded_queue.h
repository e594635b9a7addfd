#pragma once

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
    Push(std::move(item), [](const T& /*item*/) { return true; });
  }

  /// Counts as dropped only those for which `counts(item)` is true.
  template <class Counts>
  void Push(T item, const Counts& counts) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      while (capacity_ != 0 && items_.size() >= capacity_) {
        if (counts(items_.front())) ++num_dropped_;
        items_.pop_front();
      }
      items_.push_back(std::move(item));
    }
    changed_.notify_one();
  }

  /// For what is pushed from now on; nothing is dropped by this.
  void SetCapacity(std::size_t capacity) {
    const std::lock_guard<std::mutex> lock(mutex_);
    capacity_ = capacity;
  }

  /// The oldest item; nothing after `timeout` without one, and at once after Close.
  std::optional<T> PopFor(std::chrono::milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return closed_ || !items_.empty(); });
    if (closed_ || items_.empty()) return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    return item;
  }

  /// Ends all waiting; what is in the queue is forgotten.
  void Close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
      items_.clear();
    }
    changed_.notify_all();
  }

  bool closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }
  /// Items that have been dropped to make room.
  std::size_t num_dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return num_dropped_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t capacity_;
  std::deque<T> items_;
  std::size_t num_dropped_ = 0;
  bool closed_ = false;
};

}  // namespace posefusion
