#include "posefusion/simulation/texture.h"

#include <algorithm>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace posefusion {
namespace {

using Byte16 = std::uint8_t __attribute__((vector_size(16)));
using Short8 = std::uint16_t __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

/// The four bytes of a texel as floats. Interleaving with zeros, twice, is two instructions of any
/// x86-64; a plain conversion of the bytes is not.
inline Rgb4 Unpack(std::uint32_t texel) {
  const auto packed = reinterpret_cast<Byte16>(Int4{static_cast<std::int32_t>(texel), 0, 0, 0});
  const auto shorts = reinterpret_cast<Short8>(__builtin_shuffle(
      packed, Byte16{}, Byte16{0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23}));
  const auto words =
      reinterpret_cast<Int4>(__builtin_shuffle(shorts, Short8{}, Short8{0, 8, 1, 9, 2, 10, 3, 11}));
  return __builtin_convertvector(words, Rgb4);
}

/// Exponent and a linear mantissa: log2(x) within 0.09, monotonous.
float FastLog2(float x) {
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return static_cast<float>(bits) * 0x1p-23F - 127.0F;
}

/// x less the whole number below it. (std::floor is a function call without SSE 4.1.)
float Fraction(float x) {
  const auto whole = static_cast<float>(static_cast<int>(x));
  return x - whole + (x < whole ? 1.0F : 0.0F);
}

std::vector<std::uint32_t> Packed(const cv::Mat& linear) {
  std::vector<std::uint32_t> texels;
  texels.reserve(linear.total());
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      std::uint32_t texel = 0;
      for (int c = 0; c < 3; ++c) {
        const float value = std::sqrt(linear.at<cv::Vec3f>(y, x)[c]) * 255.0F;
        texel |= static_cast<std::uint32_t>(cv::saturate_cast<std::uint8_t>(value)) << (8 * c);
      }
      texels.push_back(texel);
    }
  }
  return texels;
}

}  // namespace

Texture::Texture(const cv::Mat& image) {
  if (image.type() != CV_8UC3 || image.rows != image.cols || image.empty() ||
      (image.rows & (image.rows - 1)) != 0) {
    throw std::invalid_argument("texture: not a square CV_8UC3 image with a power of two as side");
  }
  cv::Mat linear;
  image.convertTo(linear, CV_32F, 1.0 / 255.0);
  cv::multiply(linear, linear, linear);
  while (true) {
    levels_.push_back({linear.rows, Packed(linear)});
    if (linear.rows == 1) break;
    cv::Mat half;
    cv::resize(linear, half, linear.size() / 2, 0, 0, cv::INTER_AREA);
    linear = half;
  }
}

Rgb4 Texture::Bilinear(const Level& level, float u, float v) {
  const int mask = level.size - 1;
  const auto size = static_cast<float>(level.size);
  // One more repeat keeps the sum positive, so that the conversion to int rounds down.
  const float x = u * size + (size - 0.5F);
  const float y = v * size + (size - 0.5F);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const std::uint32_t* row0 = level.texels.data() + (y0 & mask) * level.size;
  const std::uint32_t* row1 = level.texels.data() + ((y0 + 1) & mask) * level.size;
  const Rgb4 a = Unpack(row0[x0 & mask]);
  const Rgb4 c = Unpack(row1[x0 & mask]);
  const Rgb4 top = a + (Unpack(row0[(x0 + 1) & mask]) - a) * fx;
  const Rgb4 bottom = c + (Unpack(row1[(x0 + 1) & mask]) - c) * fx;
  return top + (bottom - top) * fy;
}

Rgb4 Texture::Sample(float u, float v, float footprint) const {
  const float texels = std::max(footprint * static_cast<float>(levels_.front().size), 1.0F);
  const float top = static_cast<float>(levels_.size() - 1);
  const float lod = std::min(FastLog2(texels), top);
  const auto fine = static_cast<std::size_t>(lod);
  // Levels are mixed over the middle half of the way between them; nearer to one it stands alone.
  const float mix = 2 * (lod - static_cast<float>(fine)) - 0.5F;
  const float x = Fraction(u);
  const float y = Fraction(v);
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  Rgb4 value = Bilinear(levels_[mix < 1 ? fine : coarse], x, y);
  if (mix > 0 && mix < 1) value += (Bilinear(levels_[coarse], x, y) - value) * mix;
  value *= 1.0F / 255.0F;
  return value * value;
}

Rgb4 Texture::Mean() const { return Sample(0, 0, 1.0F); }

}  // namespace posefusion
