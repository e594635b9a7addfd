#pragma once

#include "posefusion/image/frame_pyramid.h"
#include "posefusion/surfel/fusion.h"
#include "posefusion/surfel/splatter.h"
#include "posefusion/surfel/surfel_map.h"
#include "test/support/rendered_room.h"

namespace posefusion::testing {

constexpr StampNs kFrameInterval = 33'000'000;

/// Fuses rendered views at their true poses.
class MapFixture {
 public:
  explicit MapFixture(int num_threads = 2, const FusionConfig& fusion = {},
                      const SurfelMapConfig& map_config = {})
      : map(map_config),
        parallel_(num_threads),
        builder_(PyramidConfig(), noise_),
        fuser_(fusion, noise_) {}

  FusionCounts Fuse(const RenderedRoom& room, const Eigen::Isometry3d& T_map_camera,
                    const cv::Mat& mask = cv::Mat()) {
    stamp_ns_ += kFrameInterval;
    builder_.Build(room.Render(SmallCamera(), T_map_camera, stamp_ns_), {mask, {}}, parallel_, pyramid_);
    return fuser_.Fuse(pyramid_, {T_map_camera, T_map_camera}, 1, parallel_, map);
  }

  ModelView Predict(const Eigen::Isometry3d& T_map_camera, SplatConfig config = {},
                    std::uint32_t first_active_frame = 0) {
    ModelView view;
    Splatter splatter(config, noise_);
    splatter.Render(map, SmallCamera(), T_map_camera, first_active_frame, parallel_, view);
    return view;
  }

  SurfelMap map;

 private:
  DepthNoiseConfig noise_;
  ParallelRunner parallel_;
  PyramidBuilder builder_;
  Fuser fuser_;
  FramePyramid pyramid_;
  StampNs stamp_ns_ = 1'000'000'000;
};

}  // namespace posefusion::testing
