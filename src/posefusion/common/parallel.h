#pragma once

#include <functional>
#include <memory>

namespace posefusion {

/// Runs loops over a fixed number of blocks on a fixed number of threads (oneTBB).
///
/// Whoever calls divides the work into blocks independent of the number of threads and lets each
/// block write only its own results; summing those in block order afterwards gives the same bits
/// for any number of threads. Calls must not be nested; one owner at a time.
class ParallelRunner {
 public:
  /// @throws std::invalid_argument when num_threads < 1.
  explicit ParallelRunner(int num_threads);
  ~ParallelRunner();
  ParallelRunner(ParallelRunner&&) noexcept;
  ParallelRunner& operator=(ParallelRunner&&) noexcept;

  int num_threads() const { return num_threads_; }

  /// Calls body(block) once for each block in [0, num_blocks), in no particular order.
  void ForEachBlock(int num_blocks, const std::function<void(int)>& body) const;

  /// Calls body(begin, end) for consecutive ranges of at most `grain` items covering [0, size).
  void ForEachRange(int size, int grain, const std::function<void(int, int)>& body) const;

 private:
  struct Arena;
  int num_threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace posefusion
