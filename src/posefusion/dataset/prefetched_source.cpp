#include "posefusion/dataset/prefetched_source.h"

#include <stdexcept>
#include <utility>

namespace posefusion {

PrefetchedSource::PrefetchedSource(std::unique_ptr<FrameSource> source, int capacity)
    : source_(std::move(source)), capacity_(static_cast<std::size_t>(capacity)) {
  if (!source_) throw std::invalid_argument("prefetched source: no source");
  if (capacity < 1) throw std::invalid_argument("prefetched source: capacity is below 1");
  num_frames_ = source_->NumFrames();
  thread_ = std::thread([this] { Run(); });
}

PrefetchedSource::~PrefetchedSource() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  item_taken_.notify_all();
  thread_.join();
}

std::optional<RgbdFrame> PrefetchedSource::Next() {
  std::unique_lock<std::mutex> lock(mutex_);
  item_added_.wait(lock, [this] { return !queue_.empty() || ended_; });
  if (queue_.empty()) return std::nullopt;
  const Item item = std::move(queue_.front());
  queue_.pop_front();
  lock.unlock();
  item_taken_.notify_one();
  if (const auto* error = std::get_if<std::exception_ptr>(&item)) std::rethrow_exception(*error);
  return std::get<std::optional<RgbdFrame>>(item);
}

void PrefetchedSource::Run() {
  for (;;) {
    Item item = Fetch();
    const auto* frame = std::get_if<std::optional<RgbdFrame>>(&item);
    const bool is_end = frame != nullptr && !frame->has_value();
    std::unique_lock<std::mutex> lock(mutex_);
    item_taken_.wait(lock, [this] { return queue_.size() < capacity_ || stopping_; });
    if (stopping_) return;
    ended_ = is_end;
    if (!is_end) queue_.push_back(std::move(item));
    lock.unlock();
    item_added_.notify_one();
    if (is_end) return;
  }
}

PrefetchedSource::Item PrefetchedSource::Fetch() {
  try {
    return source_->Next();
  } catch (...) {
    return std::current_exception();
  }
}

}  // namespace posefusion
