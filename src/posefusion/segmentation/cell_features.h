#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/image/grid.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/people_colours.h"
#include "posefusion/segmentation/seeds.h"

namespace posefusion {

/// What is known of a cell beside the skeletons of its frame, metres unless said. The trees of
/// person_trees.inc know them by these numbers.
enum CellFeature : std::uint8_t {
  kSeedDistance,        ///< to the nearest seed
  kSeedDistanceShared,  ///< the least of distances divided by their seeds' share of r
  kThickDistance,       ///< to the nearest seed of head and trunk,
  kMediumDistance,      ///< of legs and upper arms,
  kThinDistance,        ///< and of forearms
  kBehindSeed,          ///< depth beyond the nearest seed
  kBehindBody,          ///< depth beyond the body of the nearest seed
  kCellDepth,
  kOnSurface,     ///< 1 on a large plane
  kInUnseenPart,  ///< how far inside a place where a part of a body may be that was not found
  kLeavesImage,   ///< 1 where such a part goes on outside the image
  kColourRatio,   ///< PeopleColours::LogRatio, nats
  kPieceArea,     ///< ln(m^2) of the connected piece that the cell is part of, planes left out
  // Of the person whose seed is nearest:
  kNumJoints,
  kNumCertainJoints,
  kHasKnee,
  kHasAnkle,
  kHasWrists,  ///< both
  kHasHip,
  kNumCellFeatures
};

using CellFeatures = std::array<float, kNumCellFeatures>;

/// Told of single cells.
using CellListener = std::function<void(const cv::Point&, const CellFeatures&)>;

/// A frame with people in it.
struct CellScene {
  const CellGrid& cells;
  const cv::Mat& colours;                  ///< CV_8UC3 of the cells' size
  const Grid<std::uint8_t>& surfaces;      ///< not 0 on a large plane
  const std::vector<PersonSeeds>& people;  ///< seeds on surfaces do not count
  const PeopleColours* people_colours;     ///< null: nothing is known of colours
};

/// Whether the cell that shows a seed is on a large plane.
bool IsOnSurface(const Seed& seed, const CellGrid& cells, const Grid<std::uint8_t>& surfaces);

/// Reads the features of single cells. Keeps its memory between frames. Not thread-safe.
class CellFeatureReader {
 public:
  /// Nothing farther from all seeds belongs to anybody, metres.
  static constexpr float kReach = 1.2F;

  /// What it refers to must live as long as Read() is called.
  void Open(const CellScene& scene);

  /// False without depth and out of reach; `features` is then undefined.
  bool Read(const cv::Point& cell, CellFeatures& features);

 private:
  /// Seeds of one thickness.
  struct Seeds {
    SeedDistance distance;
    std::vector<float> depth_m;
    std::vector<std::size_t> person;
    void Clear();
    void Add(const Seed& seed, std::size_t number);
  };
  enum Thickness { kThick, kMedium, kThin, kNumThicknesses };
  struct Nearest {
    float squared;
    const Seeds* seeds = nullptr;
    std::size_t index = 0;
  };

  void CollectSeeds(const CellScene& scene);
  void MeasurePieces(const CellScene& scene);
  float FillPiece(const CellScene& scene, const cv::Point& first);
  void ReadDistances(const Eigen::Vector3f& p, CellFeatures& features, Nearest& nearest) const;
  void ReadUnseenParts(const Eigen::Vector3f& p, CellFeatures& features) const;
  void ReadPerson(std::size_t number, CellFeatures& features) const;

  const CellScene* scene_ = nullptr;
  std::array<Seeds, kNumThicknesses> seeds_;
  float min_depth_m_ = 0;
  float max_depth_m_ = 0;
  Grid<float> piece_area_;  ///< ln(m^2)
  std::vector<cv::Point> piece_;
};

}  // namespace posefusion
