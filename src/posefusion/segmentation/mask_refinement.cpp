#include "posefusion/segmentation/mask_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace posefusion {
namespace {

/// What the 3x3 cells around a cell say.
enum class Around { kNobody, kPerson, kBoth };

Around Look(const cv::Mat& cell_mask, int x, int y) {
  int people = 0;
  int cells = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, cell_mask.rows - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, cell_mask.cols - 1); ++i) {
      people += cell_mask.at<std::uint8_t>(j, i) != 0 ? 1 : 0;
      ++cells;
    }
  }
  if (people == 0) return Around::kNobody;
  return people == cells ? Around::kPerson : Around::kBoth;
}

/// Decides pixels of one cell that has both around it.
class MixedCell {
 public:
  MixedCell(const cv::Mat& cell_mask, const CellGrid& cells, int x, int y, float pixel_cost_m)
      : pixel_cost_m_(pixel_cost_m / static_cast<float>(cells.size_px())) {
    const auto size = static_cast<float>(cells.size_px());
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, cells.height() - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, cells.width() - 1); ++i) {
        const float depth = cells.DepthAt(i, j);
        if (depth <= 0) continue;
        const float u = (static_cast<float>(i) + 0.5F) * size - 0.5F;
        const float v = (static_cast<float>(j) + 0.5F) * size - 0.5F;
        around_[num_around_++] = {u, v, depth, cell_mask.at<std::uint8_t>(j, i) != 0};
      }
    }
  }

  bool IsPerson(int u, int v, float depth_m) const {
    float best = std::numeric_limits<float>::infinity();
    bool is_person = false;
    for (int i = 0; i < num_around_; ++i) {
      const Cell& cell = around_[i];
      const float distance_px =
          std::abs(cell.u - static_cast<float>(u)) + std::abs(cell.v - static_cast<float>(v));
      const float cost = std::abs(cell.depth_m - depth_m) + pixel_cost_m_ * distance_px;
      if (cost < best) {
        best = cost;
        is_person = cell.is_person;
      }
    }
    return is_person;
  }

 private:
  struct Cell {
    float u = 0;
    float v = 0;
    float depth_m = 0;
    bool is_person = false;
  };

  float pixel_cost_m_;
  Cell around_[9];
  int num_around_ = 0;
};

}  // namespace

MaskRefinement::MaskRefinement(const MaskRefinementConfig& config) : config_(config) {}

/// Full resolution inside `place`, in pixels; the rest of the image is not touched.
void MaskRefinement::DecidePixels(const cv::Mat& cell_mask, const CellGrid& cells,
                                  const cv::Rect& cell_box, const cv::Mat& depth_m) {
  const cv::Rect image({0, 0}, depth_m.size());
  const int size = cells.size_px();
  for (int y = cell_box.y; y < cell_box.y + cell_box.height; ++y) {
    for (int x = cell_box.x; x < cell_box.x + cell_box.width; ++x) {
      const Around around = Look(cell_mask, x, y);
      if (around == Around::kNobody) continue;
      const cv::Rect pixels = cv::Rect(x * size, y * size, size, size) & image;
      if (around == Around::kPerson) {
        fine_(pixels).setTo(255);
        continue;
      }
      const MixedCell cell(cell_mask, cells, x, y, static_cast<float>(config_.pixel_cost_m));
      for (int v = pixels.y; v < pixels.y + pixels.height; ++v) {
        const float* depth = depth_m.ptr<float>(v);
        auto* fine = fine_.ptr<std::uint8_t>(v);
        for (int u = pixels.x; u < pixels.x + pixels.width; ++u) {
          if (depth[u] > 0 && cell.IsPerson(u, v, depth[u])) fine[u] = 255;
        }
      }
    }
  }
}

void MaskRefinement::Apply(const cv::Mat& cell_mask, const CellGrid& cells, const cv::Mat& depth_m,
                           cv::Mat& mask) {
  const cv::Rect people = cv::boundingRect(cell_mask);
  if (people.empty()) return;
  const cv::Rect all_cells({0, 0}, cells.size());
  const cv::Rect cell_box =
      cv::Rect(people.x - 1, people.y - 1, people.width + 2, people.height + 2) & all_cells;
  fine_.create(depth_m.size(), CV_8UC1);
  const int size = cells.size_px();
  const int reach = std::max(config_.grow_px, config_.fill_px) + 1;
  const cv::Rect box =
      cv::Rect(cell_box.x * size - reach, cell_box.y * size - reach,
               cell_box.width * size + 2 * reach, cell_box.height * size + 2 * reach) &
      cv::Rect({0, 0}, depth_m.size());
  fine_(box).setTo(0);
  DecidePixels(cell_mask, cells, cell_box, depth_m);
  AddRim(box, depth_m, mask);
}

void MaskRefinement::AddRim(const cv::Rect& box, const cv::Mat& depth_m, cv::Mat& mask) {
  const auto square = [](int radius) {
    return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1});
  };
  constexpr int kNothingOutside = cv::BORDER_CONSTANT | cv::BORDER_ISOLATED;
  const cv::Mat fine = fine_(box);
  cv::Mat people = mask(box);
  cv::dilate(fine, grown_, square(config_.grow_px), {-1, -1}, 1, kNothingOutside);
  cv::bitwise_or(people, grown_, people);
  cv::dilate(fine, grown_, square(config_.fill_px), {-1, -1}, 1, kNothingOutside);
  cv::compare(depth_m(box), 0, without_depth_, cv::CMP_LE);
  cv::bitwise_and(grown_, without_depth_, grown_);
  cv::bitwise_or(people, grown_, people);
}

}  // namespace posefusion
