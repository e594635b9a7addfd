#include "posefusion/segmentation/boosted_trees.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace posefusion {
namespace {

constexpr std::size_t kTreesBetweenLooks = 4;

}  // namespace

BoostedTrees::BoostedTrees(std::vector<TreeNode> nodes, std::vector<int> roots, float offset)
    : nodes_(std::move(nodes)), roots_(std::move(roots)), offset_(offset) {}

float BoostedTrees::Evaluate(const float* features, float limit) const {
  float sum = offset_;
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    if (i % kTreesBetweenLooks == 0 && std::abs(sum) > limit) break;
    const TreeNode* node = &nodes_[static_cast<std::size_t>(roots_[i])];
    while (node->feature >= 0) {
      node += features[node->feature] <= node->value ? node->left : node->right;
    }
    sum += node->value;
  }
  return sum;
}

const BoostedTrees& PersonTrees() {
  static const BoostedTrees trees = [] {
#include "posefusion/segmentation/person_trees.inc"
    return BoostedTrees(nodes, roots, offset);
  }();
  return trees;
}

}  // namespace posefusion
