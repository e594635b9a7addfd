#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "posefusion/segmentation/carried_people.h"

namespace posefusion {

struct PeopleColoursConfig {
  double keep = 0.97;          ///< share of what is known that a frame with keypoints leaves
  double prior_cells = 0.05;   ///< cells of every colour that are taken as seen before any frame
  double max_log_ratio = 3.0;  ///< a colour says no more than this, nats
};

template <class V>
void Describe(V& v, PeopleColoursConfig& c) {
  v.Field("keep", c.keep, 0.0, 1.0);
  v.Field("prior_cells", c.prior_cells, 0.0001, 1000.0);
  v.Field("max_log_ratio", c.max_log_ratio, 0.0, 100.0);
}

/// The colours of the people and of what is around them, as histograms that forget, and what a
/// colour says of who shows it. Not thread-safe.
class PeopleColours {
 public:
  explicit PeopleColours(const PeopleColoursConfig& config);

  /// Adds the cells of a frame with keypoints: people where they are on seeds (`near_seeds`, see
  /// KeypointCuts), background where nobody is. `colours`: CV_8UC3 of the cells' size.
  void Add(const cv::Mat& colours, const CellPeople& people, const cv::Mat& near_seeds);

  /// ln(p(colour | person) / p(colour | background)), limited; 0 while nothing is known.
  float LogRatio(const cv::Vec3b& colour) const;

 private:
  static constexpr int kBinsPerChannel = 16;
  static constexpr int kNumBins = kBinsPerChannel * kBinsPerChannel * kBinsPerChannel;
  struct Histogram {
    std::array<float, kNumBins> cells{};
    float sum = 0;
  };
  static std::size_t BinOf(const cv::Vec3b& colour);
  float ShareOf(const Histogram& histogram, std::size_t bin) const;

  PeopleColoursConfig config_;
  Histogram people_;
  Histogram background_;
};

}  // namespace posefusion
