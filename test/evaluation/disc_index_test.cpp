#include "posefusion/evaluation/disc_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace posefusion {
namespace {

constexpr float kThicknessM = 0.01F;
constexpr double kRasterError = 0.02;  ///< of the area of two discs, by the 128 points of each

double DiscArea(double radius_m) { return M_PI * radius_m * radius_m; }

/// Area that two circles of radius r have in common when their centers are d apart.
double LensArea(double r, double d) {
  return 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
}

TEST(DiscIndex, UnionOfSeparateDiscsIsTheirSum) {
  const std::vector<Disc> discs = {
      {{0, 0, 0}, {0, 0, 1}, 0.1F}, {{1, 0, 0}, {0, 1, 0}, 0.05F}, {{-30, 0, 2}, {1, 0, 0}, 0.2F}};
  EXPECT_NEAR(UnionArea(discs, kThicknessM), DiscArea(0.1) + DiscArea(0.05) + DiscArea(0.2), 1e-6);
  EXPECT_EQ(UnionArea({}, kThicknessM), 0);
}

TEST(DiscIndex, OverlapCountsOnceInAnyDirection) {
  for (const Eigen::Vector3f& normal :
       {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(-1, 0.1F, 0)}) {
    const Eigen::Vector3f n = normal.normalized();
    const Eigen::Vector3f side = n.unitOrthogonal();
    const Disc first{{0.3F, 0.2F, 1}, n, 0.1F};
    Disc second = first;
    second.center += 0.1F * side + 0.005F * n;
    second.normal = -n;
    const double area = 2 * DiscArea(0.1) - LensArea(0.1, 0.1);
    EXPECT_NEAR(UnionArea({first, second}, kThicknessM), area, kRasterError * area);
    EXPECT_NEAR(UnionArea({first, first, second}, kThicknessM), area, kRasterError * area);
  }
}

TEST(DiscIndex, LayersFurtherApartAreTwoSurfaces) {
  const Disc first{{0, 0, 0}, {0, 0, 1}, 0.1F};
  const Disc second{{0, 0, 0.02F}, {0, 0, 1}, 0.1F};
  EXPECT_NEAR(UnionArea({first, second}, kThicknessM), 2 * DiscArea(0.1), 1e-6);
}

TEST(DiscIndex, FindsEveryDiscWithinReach) {
  std::srand(5);
  std::vector<Disc> discs;
  for (int i = 0; i < 200; ++i) {
    discs.push_back({Eigen::Vector3f::Random(), Eigen::Vector3f::Random().normalized(),
                     0.1F * std::abs(Eigen::Vector3f::Random().x())});
  }
  const DiscIndex index(discs, kThicknessM);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f point = Eigen::Vector3f::Random();
    std::set<std::uint32_t> found;
    index.AnyNear(point, [&](std::uint32_t disc) {
      found.insert(disc);
      return false;
    });
    for (std::uint32_t disc = 0; disc < discs.size(); ++disc) {
      const bool is_near = IsOver(discs[disc], point, kThicknessM) ||
                           (discs[disc].center - point).norm() <= kThicknessM;
      EXPECT_TRUE(!is_near || found.count(disc) == 1);
    }
  }
}

}  // namespace
}  // namespace posefusion
