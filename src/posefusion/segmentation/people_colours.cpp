#include "posefusion/segmentation/people_colours.h"

#include <algorithm>
#include <cmath>

#include "posefusion/segmentation/people_memory.h"

namespace posefusion {

PeopleColours::PeopleColours(const PeopleColoursConfig& config) : config_(config) {}

std::size_t PeopleColours::BinOf(const cv::Vec3b& colour) {
  constexpr int kWidth = 256 / kBinsPerChannel;
  const int bin = (colour[0] / kWidth * kBinsPerChannel + colour[1] / kWidth) * kBinsPerChannel +
                  colour[2] / kWidth;
  return static_cast<std::size_t>(bin);
}

void PeopleColours::Add(const cv::Mat& colours, const CellPeople& people,
                        const cv::Mat& near_seeds) {
  for (Histogram* histogram : {&people_, &background_}) {
    for (float& cells : histogram->cells) cells *= static_cast<float>(config_.keep);
    histogram->sum *= static_cast<float>(config_.keep);
  }
  for (int y = 0; y < colours.rows; ++y) {
    for (int x = 0; x < colours.cols; ++x) {
      const CellPerson person = people.person.at(x, y);
      if (person == kUnknownCell) continue;
      const bool is_sure = people.evidence.at(x, y) >= kFirstEvidence &&
                           near_seeds.at<std::uint8_t>(y, x) == kOnSeeds;
      if (person != kNobody && !is_sure) continue;
      Histogram& histogram = person == kNobody ? background_ : people_;
      histogram.cells[BinOf(colours.at<cv::Vec3b>(y, x))] += 1;
      histogram.sum += 1;
    }
  }
}

float PeopleColours::ShareOf(const Histogram& histogram, std::size_t bin) const {
  const auto prior = static_cast<float>(config_.prior_cells);
  return (histogram.cells[bin] + prior) / (histogram.sum + prior * kNumBins);
}

float PeopleColours::LogRatio(const cv::Vec3b& colour) const {
  const std::size_t bin = BinOf(colour);
  const auto limit = static_cast<float>(config_.max_log_ratio);
  return std::clamp(std::log(ShareOf(people_, bin) / ShareOf(background_, bin)), -limit, limit);
}

}  // namespace posefusion
