#pragma once

#include <cstdint>
#include <vector>

namespace posefusion {

/// A node of a decision tree; trees lie one after another.
struct TreeNode {
  std::int16_t feature;  ///< that is asked for; less than 0: a leaf
  std::int16_t left;     ///< nodes from this one to where features up to the value go ...
  std::int16_t right;    ///< ... and the others
  float value;           ///< limit of the feature; of a leaf its part of the sum
};

/// Sum of decision trees, as gradient boosting finds them (Friedman, "Greedy function
/// approximation: a gradient boosting machine", 2001). Thread-safe.
class BoostedTrees {
 public:
  /// `roots`: index of each tree's first node. `offset` is the sum without any tree.
  BoostedTrees(std::vector<TreeNode> nodes, std::vector<int> roots, float offset);

  /// Sum of the leaves that the features lead to. The trees come in the order of their learning:
  /// what `limit` is exceeded by after some of them is not looked at any further.
  float Evaluate(const float* features, float limit) const;

 private:
  std::vector<TreeNode> nodes_;
  std::vector<int> roots_;
  float offset_;
};

/// The log odds (nats) of a cell with CellFeatures being somebody's, learned from simulated people
/// (scripts/train_person_trees.py).
const BoostedTrees& PersonTrees();

}  // namespace posefusion
