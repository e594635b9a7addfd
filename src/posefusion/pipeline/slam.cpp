#include "posefusion/pipeline/slam.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "posefusion/common/parallel.h"
#include "posefusion/image/rectifier.h"
#include "posefusion/loop_closure/relocaliser.h"
#include "posefusion/pipeline/start_pose.h"
#include "posefusion/surfel/fusion.h"
#include "posefusion/tracking/odometry_motion.h"
#include "posefusion/tracking/tracker.h"

namespace posefusion {

/// What lives as long as the camera and the map stay the same.
struct Slam::State {
  State(const SlamConfig& config_in, int num_threads) : config(config_in), parallel(num_threads) {
    Clear();
  }

  void Clear() {
    rectifier.reset();
    builder.emplace(config.pyramid, config.depth_noise);
    tracker.emplace(config.tracking, config.depth_noise);
    odometry.emplace(config.tracking.prior);
    fuser.emplace(config.fusion, config.depth_noise);
    splatter.emplace(config.splat, config.depth_noise);
    small_splatter.reset();
    relocaliser.emplace(config.relocalisation, config.tracking, config.pyramid, config.depth_noise);
    fusion_pause_frames = 0;
    map.emplace(config.surfel_map);
    view = ModelView();
    trajectory.clear();
    last_stamp_ns.reset();
    camera.reset();
  }

  SlamConfig config;
  ParallelRunner parallel;
  Eigen::Isometry3d T_map_start = LevelStartPose();  ///< of the camera in the first frame
  std::optional<CameraModel> camera;                 ///< of the frames as they come in
  std::optional<Rectifier> rectifier;
  std::optional<PyramidBuilder> builder;
  std::optional<Tracker> tracker;
  std::optional<OdometryMotion> odometry;
  std::optional<Fuser> fuser;
  std::optional<Splatter> splatter;
  std::optional<Splatter> small_splatter;
  std::optional<Relocaliser> relocaliser;
  std::optional<SurfelMap> map;
  FramePyramid pyramid;
  ModelView view;        ///< from the last pose
  ModelView found_view;  ///< from poses where the camera may be
  ModelView small_view;  ///< the same in the resolution of the ferns
  int fusion_pause_frames = 0;
  Trajectory trajectory;
  std::optional<StampNs> last_stamp_ns;
  StageClock clock;

  void Check(const RgbdFrame& frame, const PeopleInFrame& people) const;
  void Rectify(const RgbdFrame& frame, const PeopleInFrame& people);
  void Prepare();
  TrackingResult Track(const FrameHints& hints);
  TrackingResult Follow(const std::optional<MotionPrior>& prior);
  bool IsFar(const MotionPrior& prior) const;
  void Relocalise(FrameResult& result);
  SplatConfig SmallSplat() const;
  bool MayFuse();
  void NoteTracked(const TrackingResult& tracking);
  void Draw(const Eigen::Isometry3d& T_map_camera, Splatter& with, ModelView& drawn);
  void FuseInto(const TrackingResult& tracking);
  void Predict();
  void PredictFrom(const Eigen::Isometry3d& T_map_camera);
  double MotionWeight() const;

  RgbdFrame rectified;
  PeopleInFrame rectified_people;
};

void Slam::State::Check(const RgbdFrame& frame, const PeopleInFrame& people) const {
  CheckFrame(frame, "frame " + FormatStamp(frame.stamp_ns));
  const auto fits = [&](const cv::Mat& image, int type) {
    return image.empty() || (image.type() == type && image.size() == frame.rgb.size());
  };
  if (!fits(people.mask, CV_8UC1)) {
    throw std::invalid_argument("person mask is not 8UC1 of the frame's size");
  }
  if (!fits(people.depth_m, CV_32FC1)) {
    throw std::invalid_argument("depth of people is not 32FC1 of the frame's size");
  }
  if (camera && *camera != frame.camera) {
    throw std::invalid_argument("the camera has changed; reset first");
  }
  CheckFollows(frame.stamp_ns, last_stamp_ns);
}

void Slam::State::Rectify(const RgbdFrame& frame, const PeopleInFrame& people) {
  const auto scope = clock.Measure("rectify");
  if (!rectifier) rectifier.emplace(frame.camera);
  rectified = rectifier->Rectify(frame);
  rectified_people = rectifier->Rectify(people);
}

void Slam::State::Prepare() {
  const auto scope = clock.Measure("prepare");
  builder->Build(rectified, rectified_people, parallel, pyramid);
}

TrackingResult Slam::State::Track(const FrameHints& hints) {
  const auto scope = clock.Measure("track");
  odometry->Advance(hints.T_odom_camera);
  const TrackingResult result = map->NumSurfels() == 0 ? tracker->Start(pyramid, T_map_start)
                                                       : Follow(odometry->SinceLastTracked());
  if (result.health != TrackingHealth::kFailed) odometry->NoteTracked();
  return result;
}

/// After a gap what the camera sees may hardly be in view from the last pose.
TrackingResult Slam::State::Follow(const std::optional<MotionPrior>& prior) {
  if (prior && tracker->TrustsPriors() && IsFar(*prior)) {
    PredictFrom(tracker->T_map_camera() * prior->T_last_camera);
    const TrackingResult result = tracker->Track(pyramid, view, parallel, prior);
    if (result.health != TrackingHealth::kFailed) return result;
  }
  if (view.T_map_camera.matrix() != tracker->T_map_camera().matrix()) {
    PredictFrom(tracker->T_map_camera());
  }
  return tracker->Track(pyramid, view, parallel, prior);
}

bool Slam::State::IsFar(const MotionPrior& prior) const {
  return !IsWithin(prior.T_last_camera, config.tracking.prior.predict_m,
                   config.tracking.prior.predict_rad);
}

double Slam::State::MotionWeight() const {
  const Vector6d motion = LogSE3(view.T_map_camera.inverse() * tracker->T_map_camera());
  const double speed = std::max(motion.head<3>().norm(), motion.tail<3>().norm());
  return std::max(1 - std::min(speed, config.slow_motion_m) / config.slow_motion_m,
                  config.min_motion_weight);
}

void Slam::State::FuseInto(const TrackingResult& tracking) {
  const auto scope = clock.Measure("fuse");
  const double weight = map->NumSurfels() == 0 ? 1 : MotionWeight();
  FramePoses poses;
  poses.T_map_color = tracking.T_map_camera;
  poses.T_map_depth = tracking.T_map_camera * tracker->T_color_depth();
  fuser->Fuse(pyramid, poses, weight, parallel, *map);
}

void Slam::State::Draw(const Eigen::Isometry3d& T_map_camera, Splatter& with, ModelView& drawn) {
  const StampNs window = StampFromSeconds(config.fusion.time_window_s);
  with.Render(*map, rectified.camera, T_map_camera, map->FirstFrameSince(pyramid.stamp_ns - window),
              parallel, drawn);
  BuildIntensityLevels(config.pyramid.num_levels, parallel, drawn);
}

void Slam::State::Predict() {
  const auto scope = clock.Measure("predict");
  PredictFrom(tracker->T_map_camera());
}

void Slam::State::PredictFrom(const Eigen::Isometry3d& T_map_camera) {
  Draw(T_map_camera, *splatter, view);
}

SplatConfig Slam::State::SmallSplat() const {
  SplatConfig small = config.splat;
  small.level =
      std::min(config.relocalisation.ferns.level, static_cast<int>(pyramid.levels.size()) - 1);
  return small;
}

/// Looks for a lost camera where it has been before, and goes on from there when it is found.
void Slam::State::Relocalise(FrameResult& result) {
  if (!config.relocalisation.enabled || map->NumSurfels() == 0) return;
  const auto scope = clock.Measure("relocalise");
  if (!small_splatter) small_splatter.emplace(SmallSplat(), config.depth_noise);
  MapViews views;
  views.small = [this](const Eigen::Isometry3d& T_map_camera) -> const ModelView& {
    Draw(T_map_camera, *small_splatter, small_view);
    return small_view;
  };
  views.normal = [this](const Eigen::Isometry3d& T_map_camera) -> const ModelView& {
    Draw(T_map_camera, *splatter, found_view);
    return found_view;
  };
  const auto found = relocaliser->Find(pyramid, views, parallel, *tracker);
  if (!found) return;
  tracker->Resume(pyramid, *found);
  odometry->NoteTracked();
  fusion_pause_frames = config.relocalisation.fusion_delay_frames;
  result.tracking = *found;
  result.relocalised = true;
}

/// Right after a relocalisation frames are not fused: tracking shows first that it can go on.
bool Slam::State::MayFuse() {
  if (fusion_pause_frames == 0) return true;
  --fusion_pause_frames;
  return false;
}

void Slam::State::NoteTracked(const TrackingResult& tracking) {
  if (!config.relocalisation.enabled) return;
  const auto scope = clock.Measure("keyframe");
  relocaliser->NoteTracked(pyramid, tracking);
}

Slam::Slam(const SlamConfig& config, int num_threads) {
  CheckRanges("mapping", config);
  state_ = std::make_unique<State>(config, num_threads);
}

Slam::~Slam() = default;

FrameResult Slam::ProcessFrame(const RgbdFrame& frame, const PeopleInFrame& people,
                               const FrameHints& hints) {
  State& s = *state_;
  s.Check(frame, people);
  s.clock.Clear();
  s.camera = frame.camera;
  s.last_stamp_ns = frame.stamp_ns;
  s.Rectify(frame, people);
  s.Prepare();
  FrameResult result;
  result.stamp_ns = frame.stamp_ns;
  result.tracking = s.Track(hints);
  if (!result.HasPose()) s.Relocalise(result);
  if (result.HasPose()) {
    result.fused = s.MayFuse();
    if (result.fused) s.FuseInto(result.tracking);
    s.Predict();
    s.NoteTracked(result.tracking);
    s.trajectory.push_back({frame.stamp_ns, result.tracking.T_map_camera});
  }
  result.stage_times = s.clock.times();
  return result;
}

void Slam::SetStartPose(const Eigen::Isometry3d& T_map_camera) {
  state_->T_map_start = T_map_camera;
}

void Slam::Adopt(const SlamConfig& config) {
  SlamConfig changed = state_->config;
  changed.pyramid.min_depth_m = config.pyramid.min_depth_m;
  changed.pyramid.max_depth_m = config.pyramid.max_depth_m;
  changed.export_min_confidence = config.export_min_confidence;
  CheckRanges("mapping", changed);
  state_->config = changed;
  state_->builder.emplace(changed.pyramid, changed.depth_noise);
}

void Slam::Reset() { state_->Clear(); }

const Trajectory& Slam::trajectory() const { return state_->trajectory; }

SurfelCloud Slam::ExportMap(double min_confidence) const {
  return state_->map->Export(static_cast<float>(min_confidence));
}

std::size_t Slam::NumSurfels() const { return state_->map->NumSurfels(); }

int Slam::NumKeyframes() const { return state_->relocaliser->num_keyframes(); }

cv::Mat Slam::ModelImage() const {
  State& s = *state_;
  if (!s.camera || s.trajectory.empty()) return cv::Mat();
  return s.splatter->RenderColor(*s.map, s.rectified.camera, s.tracker->T_map_camera(), s.parallel);
}

const SlamConfig& Slam::config() const { return state_->config; }

}  // namespace posefusion
