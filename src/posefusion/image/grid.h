#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace posefusion {

/// A dense image of plain values, row by row. Keeps its memory when resized to the same size, and
/// has a few spare values behind the last pixel so that kernels may read whole SIMD groups.
template <class T>
class Grid {
 public:
  Grid() = default;
  Grid(int width, int height) { Resize(width, height); }

  /// Values are undefined afterwards unless the size stays.
  void Resize(int width, int height) {
    width_ = width;
    height_ = height;
    values_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + kSpare);
  }
  void Fill(T value) { std::fill(values_.begin(), values_.end(), value); }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ == 0 || height_ == 0; }

  T* row(int y) { return values_.data() + Index(0, y); }
  const T* row(int y) const { return values_.data() + Index(0, y); }
  T& at(int x, int y) { return values_[Index(x, y)]; }
  const T& at(int x, int y) const { return values_[Index(x, y)]; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

 private:
  static constexpr std::size_t kSpare = 16;

  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> values_;
};

}  // namespace posefusion
