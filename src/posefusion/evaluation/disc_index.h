#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace posefusion {

/// A surfel's place: a flat disc, metres.
struct Disc {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< unit length
  float radius_m = 0;
};

/// Whether the point lies within `thickness_m` above or below the disc.
bool IsOver(const Disc& disc, const Eigen::Vector3f& point, float thickness_m);

/// Finds the discs near a point: each disc is listed in all cells of a regular grid that it comes
/// near to. Questions may come from several threads at once.
class DiscIndex {
 public:
  /// Discs are found from points up to `reach_m` from their center or above and below them.
  DiscIndex(std::vector<Disc> discs, float reach_m);

  const std::vector<Disc>& discs() const { return discs_; }

  /// Whether `is_wanted(index of the disc)` holds for a disc that is within reach of the point;
  /// it is also asked for some that are not, in the order of the discs.
  template <class Predicate>
  bool AnyNear(const Eigen::Vector3f& point, const Predicate& is_wanted) const {
    const auto [begin, end] = EntriesAt(CellOf(point));
    for (const Entry* entry = begin; entry != end; ++entry) {
      if (is_wanted(entry->disc)) return true;
    }
    return false;
  }

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Entry {
    Cell cell;
    std::uint32_t disc;
  };

  Cell CellOf(const Eigen::Vector3f& point) const;
  void List(std::uint32_t index, float reach_m);
  std::pair<const Entry*, const Entry*> EntriesAt(const Cell& cell) const;

  std::vector<Disc> discs_;
  std::vector<Entry> entries_;  ///< in order of cells, then discs
};

/// Area of the union of discs, m^2: of each disc the part counts that no disc before it covers
/// within `thickness_m` along that one's normal, so that noisy layers of one surface count once.
/// Each disc is rasterised to 128 points of equal area.
double UnionArea(const std::vector<Disc>& discs, float thickness_m);

}  // namespace posefusion
