#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace posefusion {

/// Runs tasks in their order on one thread of its own, so that writing a frame overlaps with making
/// the next. After a task has thrown, those behind it are dropped and each further call throws the
/// same exception. Add() and Finish() are for one thread at a time.
class TaskThread {
 public:
  /// At most `capacity` tasks wait. @throws std::invalid_argument for a capacity below 1.
  explicit TaskThread(int capacity);

  /// Ends the thread after the task it is at; those that wait are dropped.
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  /// Waits while `capacity` tasks wait. @throws what an earlier task has thrown.
  void Add(std::function<void()> task);

  /// Waits until all tasks have run. @throws what one of them has thrown.
  void Finish();

 private:
  void Run();
  void RethrowError() const;

  std::size_t capacity_;

  std::mutex mutex_;  ///< guards the four below
  std::deque<std::function<void()>> tasks_;
  bool busy_ = false;         ///< a task is running
  bool stopping_ = false;     ///< the destructor waits for the thread
  std::exception_ptr error_;  ///< of the first task that has thrown

  std::condition_variable task_added_;
  std::condition_variable task_done_;
  std::thread thread_;  ///< last: starts when everything above exists
};

}  // namespace posefusion
