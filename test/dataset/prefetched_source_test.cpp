#include "posefusion/dataset/prefetched_source.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace posefusion {
namespace {

/// Counts its frames in the stamps; frames of `bad` throw.
class CountingSource : public FrameSource {
 public:
  CountingSource(int num_frames, std::vector<int> bad, std::atomic<int>* num_made = nullptr)
      : num_frames_(num_frames), bad_(std::move(bad)), num_made_(num_made) {}

  std::optional<RgbdFrame> Next() override {
    if (next_ == num_frames_) return std::nullopt;
    const int number = next_++;
    if (num_made_ != nullptr) ++*num_made_;
    for (const int bad : bad_) {
      if (bad == number) throw std::runtime_error("frame " + std::to_string(number));
    }
    RgbdFrame frame;
    frame.stamp_ns = number;
    return frame;
  }
  std::optional<int> NumFrames() const override { return num_frames_; }

 private:
  int num_frames_;
  std::vector<int> bad_;
  std::atomic<int>* num_made_;
  int next_ = 0;
};

/// What a source gives: stamps, "error" for exceptions, until its end.
std::vector<std::string> Everything(FrameSource& source) {
  std::vector<std::string> items;
  for (;;) {
    try {
      const auto frame = source.Next();
      if (!frame) return items;
      items.push_back(std::to_string(frame->stamp_ns));
    } catch (const std::runtime_error& error) {
      items.emplace_back(error.what());
    }
  }
}

TEST(PrefetchedSource, GivesFramesAndErrorsInTheSameOrder) {
  for (const int capacity : {1, 3, 100}) {
    CountingSource plain(20, {0, 7, 8, 19});
    PrefetchedSource prefetched(std::make_unique<CountingSource>(20, std::vector<int>{0, 7, 8, 19}),
                                capacity);
    EXPECT_EQ(prefetched.NumFrames(), 20);
    EXPECT_EQ(Everything(prefetched), Everything(plain));
    EXPECT_FALSE(prefetched.Next()) << "the end stays the end";
  }
}

TEST(PrefetchedSource, EmptySourceEndsAtOnce) {
  PrefetchedSource source(std::make_unique<CountingSource>(0, std::vector<int>{}));
  EXPECT_FALSE(source.Next());
}

TEST(PrefetchedSource, HoldsNoMoreThanItsCapacity) {
  std::atomic<int> num_made = 0;
  {
    PrefetchedSource source(std::make_unique<CountingSource>(1000, std::vector<int>{}, &num_made),
                            3);
    EXPECT_TRUE(source.Next());
  }
  EXPECT_LE(num_made, 1 + 3 + 1) << "taken, waiting, and the one in the thread's hand";
}

TEST(PrefetchedSource, MayBeDestroyedAtAnyTime) {
  for (int num_taken = 0; num_taken < 50; ++num_taken) {
    PrefetchedSource source(std::make_unique<CountingSource>(40, std::vector<int>{}), 2);
    for (int i = 0; i < num_taken; ++i) source.Next();
  }
}

TEST(PrefetchedSource, RefusesWhatCannotWork) {
  EXPECT_THROW(PrefetchedSource(nullptr), std::invalid_argument);
  EXPECT_THROW(PrefetchedSource(std::make_unique<CountingSource>(1, std::vector<int>{}), 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
