#pragma once

#include <array>
#include <vector>

#include "posefusion/surfel/fusion.h"
#include "posefusion/surfel/splatter.h"
#include "test/support/rendered_room.h"

namespace posefusion::testing {

/// A map of the furnished room made from known poses, and the views and frames of it. Everything
/// in the small image of 80x60 is pyramid level 1, since frames have 160x120.
class MappedRoom {
 public:
  static constexpr int kSmallLevel = 1;

  /// Maps what the camera sees from `poses`.
  explicit MappedRoom(const std::vector<Eigen::Isometry3d>& poses) {
    for (const Eigen::Isometry3d& pose : poses) {
      const FramePyramid& seen = Frame(pose);
      for (int i = 0; i < 3; ++i) {
        Fuser(FusionConfig(), noise_).Fuse(seen, {pose, pose}, 1, parallel_, map_);
      }
    }
  }

  /// The frame seen from a pose; valid until the next one.
  const FramePyramid& Frame(const Eigen::Isometry3d& pose, const cv::Mat& mask = cv::Mat()) {
    stamp_ns_ += 33'000'000;
    builder_.Build(room_.Render(SmallCamera(), pose, stamp_ns_), {mask, {}}, parallel_, frame_);
    return frame_;
  }

  /// The view predicted from a pose in one of the resolutions; valid until the next one of it.
  const ModelView& View(const Eigen::Isometry3d& pose, int level) {
    SplatConfig splat;
    splat.level = level;
    ModelView& view = views_[static_cast<std::size_t>(level)];
    Splatter(splat, noise_).Render(map_, SmallCamera(), pose, 0, parallel_, view);
    BuildIntensityLevels(5, parallel_, view);
    return view;
  }

  const ParallelRunner& parallel() const { return parallel_; }
  const DepthNoiseConfig& noise() const { return noise_; }
  const PyramidConfig& pyramid_config() const { return pyramid_config_; }
  const FramePyramid& last_frame() const { return frame_; }

 private:
  DepthNoiseConfig noise_;
  PyramidConfig pyramid_config_;
  ParallelRunner parallel_{2};
  RenderedRoom room_ = RenderedRoom::Furnished();
  PyramidBuilder builder_{pyramid_config_, noise_};
  SurfelMap map_{SurfelMapConfig()};
  FramePyramid frame_;
  std::array<ModelView, 4> views_;
  StampNs stamp_ns_ = 0;
};

}  // namespace posefusion::testing
