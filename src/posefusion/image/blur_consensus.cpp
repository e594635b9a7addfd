#include "posefusion/image/blur_consensus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <utility>

namespace posefusion {
namespace {

class WeightedValues {
 public:
  void Add(double value, double weight) {
    values_.emplace_back(value, weight);
    sum_ += weight;
  }

  double Sum() const { return sum_; }

  double Median() {
    std::sort(values_.begin(), values_.end());
    double rest = 0.5 * sum_;
    for (const auto& [value, weight] : values_) {
      rest -= weight;
      if (rest <= 0) return value;
    }
    return 0;
  }

 private:
  std::vector<std::pair<double, double>> values_;
  double sum_ = 0;
};

void FindMotion(const std::vector<BlurTile>& tiles, double share,
                const std::vector<BlurTile>& before, double share_before,
                BlurConsensus& consensus) {
  WeightedValues x;
  WeightedValues y;
  WeightedValues length;
  WeightedValues change;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (!tiles[i].matches) continue;
    const double weight = std::sqrt(std::min(tiles[i].weight_xx, tiles[i].weight_yy));
    const cv::Point2d moved_px = share * tiles[i].moved_px;
    x.Add(moved_px.x, weight);
    y.Add(moved_px.y, weight);
    length.Add(cv::norm(moved_px), weight);
    if (before.empty()) continue;
    change.Add(cv::norm(moved_px - share_before * before[i].moved_px), weight);
  }
  consensus.moved_px = {x.Median(), y.Median()};
  consensus.length_px = length.Median();
  consensus.change_px = change.Median();
}

void FindGrowth(const std::vector<BlurTile>& tiles, BlurConsensus& consensus) {
  WeightedValues xx;
  WeightedValues yy;
  for (const BlurTile& tile : tiles) {
    if (!tile.matches) continue;
    xx.Add(tile.growth_xx_px2, tile.weight_xx);
    yy.Add(tile.growth_yy_px2, tile.weight_yy);
  }
  consensus.growth_xx_px2 = xx.Median();
  consensus.growth_yy_px2 = yy.Median();
  WeightedValues deviation;
  for (const BlurTile& tile : tiles) {
    if (!tile.matches) continue;
    deviation.Add(std::abs(tile.growth_xx_px2 - consensus.growth_xx_px2), tile.weight_xx);
    deviation.Add(std::abs(tile.growth_yy_px2 - consensus.growth_yy_px2), tile.weight_yy);
  }
  consensus.spread_px2 = deviation.Median();
  consensus.error_px2 =
      1 / std::sqrt(std::max(deviation.Sum(), std::numeric_limits<double>::epsilon()));
}

}  // namespace

BlurConsensus FindConsensus(const std::vector<BlurTile>& tiles, double share,
                            const std::vector<BlurTile>& before, double share_before) {
  BlurConsensus consensus;
  FindMotion(tiles, share, before, share_before, consensus);
  FindGrowth(tiles, consensus);
  return consensus;
}

}  // namespace posefusion
