#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "posefusion/segmentation/background_surfaces.h"
#include "posefusion/segmentation/cell_features.h"
#include "posefusion/segmentation/human_removal_config.h"

namespace posefusion {

/// Seeds that do not come from keypoints, such as a mask carried over from an earlier frame. Both
/// images are CV_8UC1 of the size of the cell grid (PersonCutter::CellSize); not 0 = certain.
struct CellSeeds {
  cv::Mat person;      ///< cells that are person whatever the cut finds; need depth to count
  cv::Mat background;  ///< cells that are not; may be empty. Wins where both are set
};

/// What is to be cut out of a frame.
struct CutRequest {
  const Skeletons* skeletons = nullptr;  ///< of this very frame; none when null
  const CellGrid* cells = nullptr;       ///< of the frame, where they are known; null: built
  std::vector<CellSeeds> cell_seeds;     ///< each is one cut of its own: one per carried person
  cv::Mat
      known_people;  ///< CV_8UC1 cells: not 0 = person by what is known; no plane is found there
  std::vector<Plane>* planes = nullptr;           ///< of the frame before; become those of this one
  std::optional<Eigen::Vector3f> gravity;         ///< unit vector downwards, camera frame
  const PeopleColours* people_colours = nullptr;  ///< null: not known
  /// Told of every cell that the learned data term judges, or would judge; to learn it.
  CellListener on_cell;
};

/// Cuts people out of RGB-D frames (paper, section III-B): lifts joints to seeds, solves a min-cut
/// on a grid of cells in a region around each person, brings the cut to full resolution.
///
/// Each person and each entry of cell_seeds is cut alone; the mask is the union. The result
/// depends on nothing but frame, request and config. Keeps its memory. Not thread-safe.
class PersonCutter {
 public:
  /// @throws std::invalid_argument naming the key for a value out of range.
  explicit PersonCutter(const HumanRemovalConfig& config);
  ~PersonCutter();

  /// `mask` becomes CV_8UC1 of the frame's size, 255 = person, in the incoming pixel grid. It is
  /// written in place when it has that size already; hand in an empty one for new memory.
  void Cut(const RgbdFrame& frame, const CutRequest& request, cv::Mat& mask);
  void Cut(const RgbdFrame& frame, const Skeletons& skeletons, cv::Mat& mask);

  /// The first half of Cut(): cells only. See cuts().
  void CutCells(const RgbdFrame& frame, const CutRequest& request);

  /// The second half: brings any mask of the cells (CV_8UC1, 255 = person) of the frame cut last to
  /// full resolution.
  void Refine(const RgbdFrame& frame, const cv::Mat& cell_mask, cv::Mat& mask);

  /// Size of the cell grid of a frame.
  cv::Size CellSize(const RgbdFrame& frame) const;

  /// Of the last frame cut: cells with their depth, and the people of the skeletons with their
  /// seeds, in their order.
  const CellGrid& cells() const;
  const Grid<std::uint8_t>& background_cells() const;  ///< 1 = on a surface that is no person's
  const std::vector<PersonSeeds>& people() const;
  const cv::Mat& colours() const;  ///< CV_8UC3, mean colour of each cell

  /// Each cut by itself, CV_8UC1 of the cells' size, 255 = person: the people of the skeletons,
  /// then the entries of cell_seeds, in their order.
  const std::vector<cv::Mat>& cuts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace posefusion
