#include "posefusion/common/task_thread.h"

#include <stdexcept>
#include <utility>

namespace posefusion {

TaskThread::TaskThread(int capacity) : capacity_(static_cast<std::size_t>(capacity)) {
  if (capacity < 1) throw std::invalid_argument("task thread: capacity is below 1");
  thread_ = std::thread([this] { Run(); });
}

TaskThread::~TaskThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  task_added_.notify_all();
  thread_.join();
}

void TaskThread::Add(std::function<void()> task) {
  std::unique_lock<std::mutex> lock(mutex_);
  task_done_.wait(lock, [this] { return tasks_.size() < capacity_ || error_; });
  RethrowError();
  tasks_.push_back(std::move(task));
  lock.unlock();
  task_added_.notify_one();
}

void TaskThread::Finish() {
  std::unique_lock<std::mutex> lock(mutex_);
  task_done_.wait(lock, [this] { return (tasks_.empty() && !busy_) || error_; });
  RethrowError();
}

void TaskThread::RethrowError() const {
  if (error_) std::rethrow_exception(error_);
}

void TaskThread::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!error_) {
    task_added_.wait(lock, [this] { return !tasks_.empty() || stopping_; });
    if (stopping_) return;
    std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      task();
    } catch (...) {
      error = std::current_exception();
    }
    task = nullptr;
    lock.lock();
    busy_ = false;
    error_ = error;
    if (error_) tasks_.clear();
    task_done_.notify_all();
  }
}

}  // namespace posefusion
