#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/paint.h"

namespace posefusion::paint {
namespace {

cv::Scalar ToScalar(Color color) { return {double(color[0]), double(color[1]), double(color[2])}; }

/// Multiplies a rectangle of the image by a factor.
void Tone(cv::Mat& image, const cv::Rect& area, double factor) {
  cv::Mat part = image(area & cv::Rect(0, 0, image.cols, image.rows));
  part.convertTo(part, -1, factor);
}

/// Short random dashes that read as fibres, loops or speckles.
void AddFlecks(cv::Mat& image, int count, int length, double tone, std::uint32_t seed) {
  HashSequence random(seed);
  for (int i = 0; i < count; ++i) {
    const cv::Rect fleck(random.Below(image.cols - length), random.Below(image.rows - 2),
                         1 + random.Below(length), 1 + random.Below(2));
    Tone(image, fleck, 1 + tone * static_cast<double>(random.Uniform(-1, 1)));
  }
}

}  // namespace

cv::Mat Plain(Color color) { return {4, 4, CV_8UC3, ToScalar(color)}; }

cv::Mat Plaster(Color color, double contrast, std::uint32_t seed) {
  const cv::Mat grain = Noise(512, 24, 24, 4, seed);
  return Shade(color, grain, contrast / 128.0);
}

cv::Mat FloorBoards(Color color, std::uint32_t seed) {
  constexpr int kSize = 1024;
  constexpr int kBoards = 16;
  constexpr int kWidth = kSize / kBoards;
  const cv::Mat grain = Noise(kSize, 6, 128, 4, seed);
  cv::Mat image = Shade(color, grain, 0.16);
  HashSequence random(seed, 1);
  for (int board = 0; board < kBoards; ++board) {
    const int top = board * kWidth;
    int x = random.Below(300);
    const int first = x;
    while (x < kSize + first) {
      const int length = 350 + random.Below(330);
      const int end = std::min(x + length, kSize + first);
      const double tone = static_cast<double>(random.Uniform(0.8F, 1.12F));
      Tone(image, {x % kSize, top, std::min(end - x, kSize - x % kSize), kWidth}, tone);
      if (x % kSize + (end - x) > kSize) Tone(image, {0, top, end % kSize, kWidth}, tone);
      Tone(image, {x % kSize, top, 2, kWidth}, 0.5);
      x = end;
    }
    Tone(image, {0, top, kSize, 2}, 0.5);
  }
  AddFlecks(image, 900, 22, 0.22, seed + 2);
  return image;
}

cv::Mat Wood(Color color, std::uint32_t seed) {
  const cv::Mat warp = Noise(512, 3, 4, 3, seed);
  cv::Mat rings(512, 512, CV_32FC1);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const float phase = static_cast<float>(y) * static_cast<float>(CV_2PI) * 9 / 512;
      rings.at<float>(y, x) = std::sin(phase + 7 * warp.at<float>(y, x));
    }
  }
  const cv::Mat pores = Noise(512, 12, 128, 3, seed + 1);
  cv::Mat image = Shade(color, 0.5 * rings + pores, 0.13);
  AddFlecks(image, 700, 26, 0.2, seed + 2);
  return image;
}

cv::Mat Carpet(Color color, Color pattern, std::uint32_t seed) {
  cv::Mat image = Shade(color, Noise(512, 96, 96, 3, seed), 0.22);
  const cv::Mat woven = Shade(pattern, Noise(512, 96, 96, 3, seed + 1), 0.22);
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8UC1);
  for (int i = 0; i < 4; ++i) {
    cv::rectangle(mask, {18 + 52 * i, 18 + 52 * i}, {493 - 52 * i, 493 - 52 * i}, 255, 9);
    cv::ellipse(mask, {256, 256}, {200 - 45 * i, 120 - 22 * i}, 45, 0, 360, 255, 7);
  }
  woven.copyTo(image, mask);
  return image;
}

cv::Mat CeilingTiles(std::uint32_t seed) {
  cv::Mat image = Shade({226, 226, 222}, Noise(512, 64, 64, 3, seed), 0.02);
  AddFlecks(image, 5000, 4, 0.2, seed + 1);
  for (int i = 0; i < 2; ++i) {
    Tone(image, {i * 256, 0, 5, 512}, 0.86);
    Tone(image, {0, i * 256, 512, 5}, 0.86);
  }
  return image;
}

cv::Mat Cardboard(std::uint32_t seed) {
  cv::Mat image = Shade({186, 150, 106}, Noise(256, 4, 96, 3, seed), 0.06);
  cv::rectangle(image, {0, 112}, {255, 142}, {206, 184, 140}, cv::FILLED);
  HashSequence random(seed);
  cv::rectangle(image, {30, 30}, {110, 90}, {238, 238, 232}, cv::FILLED);
  for (int i = 0; i < 6; ++i) {
    cv::line(image, {38, 40 + 8 * i}, {60 + random.Below(44), 40 + 8 * i}, {40, 40, 46}, 2);
  }
  cv::arrowedLine(image, {190, 90}, {190, 30}, {60, 50, 44}, 5, cv::LINE_AA, 0, 0.35);
  cv::arrowedLine(image, {220, 90}, {220, 30}, {60, 50, 44}, 5, cv::LINE_AA, 0, 0.35);
  cv::putText(image, "FRAGILE", {28, 205}, cv::FONT_HERSHEY_DUPLEX, 1.4, {150, 40, 34}, 3,
              cv::LINE_AA);
  return image;
}

cv::Mat Radiator() {
  cv::Mat image(256, 256, CV_8UC3);
  for (int x = 0; x < 256; ++x) {
    const double wave = 0.5 + 0.5 * std::cos(x * CV_2PI / 32);
    const double grey = 150 + 82 * std::sqrt(wave);
    image.col(x).setTo(cv::Scalar(grey, grey, grey - 6));
  }
  return image;
}

cv::Mat Leaves(std::uint32_t seed) {
  cv::Mat image = Shade({34, 74, 30}, Noise(256, 8, 8, 4, seed), 0.4);
  HashSequence random(seed);
  for (int i = 0; i < 160; ++i) {
    const cv::Point center(random.Below(256), random.Below(256));
    const double green = 70 + random.Below(110);
    cv::ellipse(image, center, {6 + random.Below(16), 3 + random.Below(5)}, random.Below(180), 0,
                360, {green * 0.45, green, green * 0.3}, cv::FILLED, cv::LINE_AA);
  }
  return image;
}

cv::Mat Fabric(Cloth cloth, Color color, Color second, std::uint32_t seed) {
  constexpr int kSize = 256;
  const cv::Mat folds = Noise(kSize, 5, 4, 3, seed);
  const cv::Mat weave = Noise(kSize, 128, 128, 1, seed + 1);
  cv::Mat image = Shade(color, 0.6 * folds + 0.5 * weave, cloth == Cloth::kDenim ? 0.25 : 0.15);
  const cv::Mat other = Shade(second, 0.6 * folds + 0.5 * weave, 0.15);
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8UC1);
  HashSequence random(seed);
  const int step = 32 + 8 * random.Below(3);
  for (int i = 0; i < kSize; i += step) {
    if (cloth == Cloth::kStripes || cloth == Cloth::kChecks) {
      mask.rowRange(i, std::min(i + step / 2, kSize)).setTo(255);
    }
    if (cloth == Cloth::kChecks) {
      cv::Mat columns = mask.colRange(i, std::min(i + step / 2, kSize));
      columns.setTo(255);
    }
  }
  if (cloth == Cloth::kPrint) {
    cv::circle(mask, {128, 110}, 26, 255, 7, cv::LINE_AA);
    cv::putText(mask, "POSE", {86, 176}, cv::FONT_HERSHEY_DUPLEX, 1.0, 255, 3, cv::LINE_AA);
  }
  if (cloth == Cloth::kDenim) mask.colRange(126, 130).setTo(255);
  other.copyTo(image, mask);
  return image;
}

}  // namespace posefusion::paint
