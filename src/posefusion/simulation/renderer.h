#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/camera_model.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Values of label images.
constexpr int kLabelNone = 0;     ///< nothing there (never in a closed room)
constexpr int kLabelStatic = 1;   ///< never moves
constexpr int kLabelMovable = 2;  ///< an object that is moved at some time
constexpr int kLabelPerson = 10;  ///< person i has kLabelPerson + i

/// What an ideal camera sees at one moment.
struct View {
  cv::Mat radiance;  ///< CV_32FC3 linear R G B, 1 = white paper in good light
  cv::Mat depth_m;   ///< CV_32FC1 exact metres along the optical axis, 0 = none
  cv::Mat labels;    ///< CV_8UC1, kLabel...
  cv::Mat surface;   ///< CV_8UC2: 255 * cosine of incidence, 255 * infrared reflectance
};

/// Casts rays into a world with Embree. Images are the same for any number of threads.
/// One owner at a time: a render moves people and things to its time.
class Renderer {
 public:
  /// Prepares geometry and the light on all static surfaces. `world` must outlive the renderer.
  explicit Renderer(const World& world);
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  /// All images at one time. A camera with distortion is rendered with its distortion.
  View Render(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera, double time_s,
              const ParallelRunner& runner);

  /// The same without radiance.
  View RenderDepth(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera, double time_s,
                   const ParallelRunner& runner);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace posefusion
