#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/simulation/hash_random.h"
#include "posefusion/simulation/paint.h"

namespace posefusion::paint {
namespace {

cv::Scalar RandomColor(HashSequence& random, int low, int high) {
  const auto channel = [&] { return double(low + random.Below(high - low)); };
  const double r = channel();
  const double g = channel();
  return {r, g, channel()};
}

/// Lines of dashes that look like printed words.
void AddText(cv::Mat& image, const cv::Rect& area, int line_px, const cv::Scalar& ink,
             HashSequence& random) {
  for (int y = area.y; y + line_px / 2 < area.y + area.height; y += line_px) {
    int x = area.x;
    const int end = area.x + area.width - random.Below(std::max(area.width / 3, 1));
    while (x < end) {
      const int word = line_px / 2 + random.Below(line_px * 2);
      cv::line(image, {x, y}, {std::min(x + word, end), y}, ink, std::max(line_px * 2 / 5, 1));
      x += word + line_px / 2;
    }
  }
}

/// A photograph-like picture: sky, hills and blobs.
void AddPicture(cv::Mat& image, const cv::Rect& area, HashSequence& random) {
  cv::Mat part = image(area);
  const cv::Mat noise = Noise(512, 4, 4, 6, random.Next());
  const cv::Scalar near = RandomColor(random, 20, 180);
  const cv::Scalar far = RandomColor(random, 90, 240);
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.cols; ++x) {
      const float n = noise.at<float>(y % 512, x % 512);
      const double mix = std::clamp(double(y) / part.rows + 0.6 * double(n), 0.0, 1.0);
      for (int c = 0; c < 3; ++c) {
        const double value = (near[c] * mix + far[c] * (1 - mix)) * (1 + 0.35 * double(n));
        part.at<Color>(y, x)[c] = cv::saturate_cast<std::uint8_t>(value);
      }
    }
  }
  for (int i = 0; i < 7; ++i) {
    cv::circle(part, {random.Below(part.cols), random.Below(part.rows)}, 6 + random.Below(40),
               RandomColor(random, 10, 250), random.Below(3) == 0 ? 5 : cv::FILLED, cv::LINE_AA);
  }
}

void AddChart(cv::Mat& image, const cv::Rect& area, HashSequence& random) {
  cv::rectangle(image, area, {246, 246, 242}, cv::FILLED);
  cv::rectangle(image, area, {40, 40, 44}, 2);
  const int bars = 5 + random.Below(5);
  for (int i = 0; i < bars; ++i) {
    const int height = area.height / 6 + random.Below(area.height * 2 / 3);
    const int width = area.width / bars;
    const cv::Rect bar(area.x + i * width + 3, area.y + area.height - height, width - 6, height);
    cv::rectangle(image, bar, RandomColor(random, 30, 220), cv::FILLED);
  }
}

}  // namespace

cv::Mat BookSpines(std::uint32_t seed) {
  cv::Mat image(1024, 1024, CV_8UC3);
  HashSequence random(seed);
  for (int i = 0; i < 16; ++i) {
    const cv::Rect cell((i % 8) * 128, (i / 8) * 512, 128, 512);
    const cv::Scalar cover = RandomColor(random, 25, 215);
    cv::rectangle(image, cell, cover, cv::FILLED);
    const cv::Scalar ink =
        cover[0] + cover[1] + cover[2] > 330 ? cv::Scalar(28, 26, 30) : cv::Scalar(232, 222, 190);
    for (int band = 0; band < 3; ++band) {
      const int y = cell.y + random.Below(480);
      cv::line(image, {cell.x, y}, {cell.x + 127, y}, ink, 3 + random.Below(9));
    }
    for (int letter = 0; letter < 9; ++letter) {  // the title runs down the spine
      const cv::Point from(cell.x + 40 + random.Below(14), cell.y + 110 + letter * 30);
      cv::rectangle(image, from, from + cv::Point(20 + random.Below(28), 8 + random.Below(14)), ink,
                    random.Below(2) == 0 ? cv::FILLED : 5);
    }
  }
  return image;
}

cv::Mat Poster(std::uint32_t seed) {
  HashSequence random(seed);
  cv::Mat image(1024, 1024, CV_8UC3, RandomColor(random, 180, 250));
  cv::rectangle(image, {0, 0}, {1023, 130}, RandomColor(random, 20, 130), cv::FILLED);
  AddText(image, {60, 50, 900, 60}, 44, {248, 248, 244}, random);
  for (int column = 0; column < 3; ++column) {
    int y = 165;
    while (y < 860) {
      const cv::Rect area(30 + column * 335, y, 295, 120 + random.Below(170));
      const int kind = random.Below(4);
      const cv::Rect fit = area & cv::Rect(0, 0, 1024, 1000);
      if (kind == 0) AddPicture(image, fit, random);
      if (kind == 1) AddChart(image, fit, random);
      if (kind >= 2) AddText(image, fit, 16 + random.Below(10), {44, 44, 50}, random);
      y += area.height + 22;
    }
  }
  return image;
}

cv::Mat Whiteboard(std::uint32_t seed) {
  cv::Mat image(1024, 1024, CV_8UC3, cv::Scalar(236, 238, 238));
  HashSequence random(seed);
  const cv::Scalar pens[] = {{30, 40, 120}, {24, 24, 28}, {170, 30, 34}, {20, 110, 50}};
  for (int stroke = 0; stroke < 70; ++stroke) {
    cv::Point at(80 + random.Below(860), 80 + random.Below(860));
    const cv::Scalar pen = pens[random.Below(4)];
    for (int i = 0; i < 9; ++i) {
      const cv::Point next = at + cv::Point(random.Below(34) - 8, random.Below(44) - 22);
      cv::line(image, at, next, pen, 4, cv::LINE_AA);
      at = next;
    }
  }
  for (int i = 0; i < 5; ++i) {
    const cv::Point corner(100 + random.Below(600), 100 + random.Below(600));
    cv::rectangle(image, corner, corner + cv::Point(160, 100), pens[i % 4], 5, cv::LINE_AA);
    cv::arrowedLine(image, corner + cv::Point(160, 50), corner + cv::Point(260, 90), pens[1], 5);
  }
  cv::rectangle(image, {0, 0}, {1023, 1023}, {120, 122, 126}, 22);
  return image;
}

cv::Mat Corkboard(std::uint32_t seed) {
  cv::Mat cork = Shade({170, 120, 74}, Noise(512, 128, 128, 2, seed), 0.3);
  cv::Mat image;
  cv::resize(cork, image, {1024, 1024});
  HashSequence random(seed);
  for (int i = 0; i < 16; ++i) {
    const cv::Rect note((i % 4) * 250 + 24 + random.Below(40),
                        (i / 4) * 245 + 22 + random.Below(36), 150 + random.Below(50),
                        130 + random.Below(60));
    cv::rectangle(image, note, RandomColor(random, 170, 250), cv::FILLED);
    const cv::Rect inside(note.x + 12, note.y + 22, note.width - 24, note.height - 30);
    if (i % 3 == 0) {
      AddPicture(image, inside, random);
    } else {
      AddText(image, inside, 16, {50, 50, 90}, random);
    }
    cv::circle(image, {note.x + note.width / 2, note.y + 6}, 8, {190, 30, 30}, cv::FILLED);
  }
  cv::rectangle(image, {0, 0}, {1023, 1023}, {110, 76, 48}, 26);
  return image;
}

cv::Mat Keyboard(std::uint32_t seed) {
  cv::Mat image(512, 512, CV_8UC3, cv::Scalar(38, 38, 42));
  HashSequence random(seed);
  for (int row = 0; row < 6; ++row) {
    for (int x = 10 + random.Below(14); x < 480; x += 29) {
      const cv::Rect key(x, 14 + row * 83, row == 5 && x > 110 && x < 320 ? 29 : 25, 70);
      cv::rectangle(image, key, {78, 78, 84}, cv::FILLED);
      cv::line(image, {x + 8, key.y + 26}, {x + 15, key.y + 26 + random.Below(20)}, {214, 214, 214},
               3);
    }
  }
  return image;
}

cv::Mat Screen(std::uint32_t seed) {
  cv::Mat image(512, 512, CV_8UC3, cv::Scalar(40, 64, 110));
  HashSequence random(seed);
  for (int window = 0; window < 3; ++window) {
    const cv::Rect area(20 + 90 * window, 30 + 70 * window, 290, 290);
    const bool dark = random.Below(2) == 0;
    cv::rectangle(image, area, dark ? cv::Scalar(30, 32, 38) : cv::Scalar(244, 244, 246),
                  cv::FILLED);
    cv::rectangle(image, {area.x, area.y, area.width, 18}, {150, 156, 168}, cv::FILLED);
    const cv::Rect text(area.x + 10, area.y + 30, area.width - 20, area.height - 36);
    AddText(image, text, 11, dark ? cv::Scalar(150, 214, 150) : cv::Scalar(40, 40, 60), random);
  }
  cv::rectangle(image, {0, 0}, {511, 511}, {14, 14, 16}, 16);
  return image;
}

cv::Mat PrintedPaper(std::uint32_t seed) {
  cv::Mat image(256, 256, CV_8UC3, cv::Scalar(240, 240, 236));
  HashSequence random(seed);
  AddText(image, {24, 24, 208, 130}, 10, {50, 50, 54}, random);
  AddChart(image, {40, 168, 170, 70}, random);
  return image;
}

cv::Mat OutsideWindow(std::uint32_t seed) {
  cv::Mat image(512, 512, CV_8UC3);
  for (int y = 0; y < 512; ++y) image.row(y).setTo(cv::Scalar(236 + y / 32, 244 + y / 64, 254));
  HashSequence random(seed);
  for (int i = 0; i < 40; ++i) {
    cv::circle(image, {random.Below(512), 380 + random.Below(140)}, 16 + random.Below(40),
               {180 + double(random.Below(40)), 206 + double(random.Below(40)), 176}, cv::FILLED);
  }
  return image;
}

cv::Mat Head(Color skin, Color hair, std::uint32_t seed) {
  cv::Mat image = Shade(hair, Noise(256, 64, 6, 3, seed), 0.5);
  const cv::Mat face = Shade(skin, Noise(256, 12, 12, 3, seed + 1), 0.07);
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8UC1);
  cv::ellipse(mask, {128, 158}, {50, 72}, 0, 0, 360, 255, cv::FILLED);
  mask.rowRange(205, 256).setTo(255);  // chin and neck, seen from all sides
  face.copyTo(image, mask);
  const cv::Scalar dark(hair[0] * 0.5, hair[1] * 0.5, hair[2] * 0.5);
  for (const int side : {-1, 1}) {
    cv::ellipse(image, {128 + side * 20, 138}, {8, 4}, 0, 0, 360, {238, 236, 232}, cv::FILLED);
    cv::circle(image, {128 + side * 20, 138}, 4, {40, 30, 26}, cv::FILLED);
    cv::line(image, {128 + side * 10, 124}, {128 + side * 32, 124}, dark, 4);
  }
  cv::line(image, {128, 140}, {124, 166}, {skin[0] * 0.72, skin[1] * 0.68, skin[2] * 0.66}, 3);
  cv::ellipse(image, {128, 186}, {16, 5}, 0, 0, 360, {164, 84, 80}, cv::FILLED);
  return image;
}

}  // namespace posefusion::paint
