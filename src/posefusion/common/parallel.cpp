#include "posefusion/common/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace posefusion {

struct ParallelRunner::Arena {
  explicit Arena(int num_threads)
      : limit(tbb::global_control::max_allowed_parallelism,
              std::max(static_cast<std::size_t>(num_threads),
                       static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()))),
        arena(num_threads) {}
  tbb::global_control limit;  ///< lets an arena be larger than the number of cores
  tbb::task_arena arena;
};

ParallelRunner::ParallelRunner(int num_threads) : num_threads_(num_threads) {
  if (num_threads < 1) {
    throw std::invalid_argument("num_threads must be at least 1, got " +
                                std::to_string(num_threads));
  }
  if (num_threads > 1) arena_ = std::make_unique<Arena>(num_threads);
}

ParallelRunner::~ParallelRunner() = default;
ParallelRunner::ParallelRunner(ParallelRunner&&) noexcept = default;
ParallelRunner& ParallelRunner::operator=(ParallelRunner&&) noexcept = default;

void ParallelRunner::ForEachBlock(int num_blocks, const std::function<void(int)>& body) const {
  if (!arena_) {
    for (int block = 0; block < num_blocks; ++block) body(block);
    return;
  }
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, num_blocks, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int block = range.begin(); block < range.end(); ++block) body(block);
        },
        tbb::simple_partitioner());
  });
}

void ParallelRunner::ForEachRange(int size, int grain,
                                  const std::function<void(int, int)>& body) const {
  const int num_blocks = (size + grain - 1) / grain;
  ForEachBlock(num_blocks, [&](int block) {
    const int begin = block * grain;
    body(begin, std::min(begin + grain, size));
  });
}

}  // namespace posefusion
