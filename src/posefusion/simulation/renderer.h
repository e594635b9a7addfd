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

constexpr double kNear_m = 0.02;

/// What an ideal camera sees at one moment.
struct View {
  cv::Mat radiance;  ///< CV_32FC3 linear R G B, 1 = white paper in good light
  cv::Mat depth_m;   ///< CV_32FC1 exact metres along the optical axis, 0 = none
  cv::Mat labels;    ///< CV_8UC1, kLabel...
  cv::Mat surface;   ///< CV_8UC2: 255 * cosine of incidence, 255 * infrared reflectance
  cv::Mat bodies;    ///< CV_8UC1: number of the rigid body, 255 = none
};

/// A camera over the time that its shutter is open. Times are seconds, poses those of the camera.
struct Exposure {
  double start_s = 0;  ///< of the first row
  double end_s = 0;    ///< of the last row
  double open_s = 0;   ///< how long each row is exposed; rows follow each other when this is less
  int max_views = 24;  ///< averaged where the image moves fast
};

/// What a real shutter makes of it.
struct ExposedView {
  View middle;        ///< at the middle of the exposure, without blur
  cv::Mat radiance;   ///< CV_32FC3 linear, with motion blur
  cv::Mat motion_px;  ///< CV_32FC1: way of the content during the exposure, every 4th pixel
};

/// Casts rays into a world with Embree. Images are the same for any number of threads.
/// One owner at a time: a render moves people and things to its time.
class Renderer {
 public:
  /// Prepares geometry and the light on all static surfaces. `world` must outlive the renderer.
  explicit Renderer(const World& world);
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  /// All images at one time. A camera with distortion is rendered with its distortion. Surfaces
  /// nearer than near_m are looked through, which opens rooms for a camera above their ceilings.
  View Render(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera, double time_s,
              const ParallelRunner& runner, double near_m = kNear_m);

  /// The image with motion blur: the mean of several views where it moves by more than a pixel.
  ExposedView Expose(const CameraModel& camera, const HeadMotion& head, const Exposure& exposure,
                     const ParallelRunner& runner);

  /// As Render(), without radiance.
  View RenderDepth(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera, double time_s,
                   const ParallelRunner& runner);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace posefusion
