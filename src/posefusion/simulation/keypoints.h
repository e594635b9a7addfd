#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "posefusion/image/camera_model.h"
#include "posefusion/simulation/person.h"
#include "posefusion/simulation/world.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// A true joint seen by the camera.
struct TrueJoint {
  double u = 0;
  double v = 0;
  double depth_m = 0;
  bool visible = false;  ///< in the image, and nothing but the person is in front of it
};

struct TruePerson {
  int person = 0;  ///< number in the world
  std::array<TrueJoint, kNumCocoJoints> joints;
  int NumVisible() const;
};

/// Everybody with at least one visible joint. `labels` is the label image of that time.
std::vector<TruePerson> ProjectPeople(const World& world, const CameraModel& camera,
                                      const Eigen::Isometry3d& T_map_camera, double time_s,
                                      const cv::Mat& labels);

/// How a pose network errs. The kinds of faults are those that Cao et al. 2019 (OpenPose) show:
/// missing joints, joints taken for the other side's, missing people, people seen in things. The
/// shares are assumptions on the pessimistic side.
struct KeypointFaultConfig {
  double missed_joint = 0.06;     ///< share of visible joints not found
  double missed_person = 0.05;    ///< share of time for which a person is not found
  double few_joints_factor = 3;   ///< people with few visible joints are missed so much more often
  double false_person_hz = 0.08;  ///< people found where nobody is, per second
  double noise_share = 0.012;     ///< deviation of a joint, of the person's height in the image
  double min_noise_px = 1.0;
  double outlier = 0.01;        ///< share of joints far off (taken for the other side's)
  double hidden_found = 0.25;   ///< share of joints hidden by something else that are guessed
  double fault_seconds = 0.35;  ///< how long a miss or a false person lasts
};

/// What a network finds instead of the truth; people in the order of the truth, then false ones.
/// Misses last for some frames, as they do in real sequences. A pure function of its arguments.
std::vector<Skeleton> DetectPeople(const std::vector<TruePerson>& truth,
                                   const KeypointFaultConfig& config, const CameraModel& camera,
                                   double time_s, int seed);

/// The truth as a perfect network would give it: visible joints with confidence 1.
std::vector<Skeleton> PerfectKeypoints(const std::vector<TruePerson>& truth);

/// When a network delivers. Rates and delays act on image stamps.
struct KeypointTiming {
  double rate_hz = 0;           ///< 0 = every frame
  double latency_s = 0;         ///< 0 = on time
  double latency_jitter = 0.2;  ///< of the latency, uniformly to either side
};

/// Time of arrival of the keypoints of a frame; empty when the network leaves it out. `interval_s`
/// is the time between frames.
std::optional<double> KeypointArrival(const KeypointTiming& timing, double time_s,
                                      double interval_s, int seed);

template <class V>
void Describe(V& v, KeypointFaultConfig& c) {
  v.Field("missed_joint", c.missed_joint, 0.0, 1.0);
  v.Field("missed_person", c.missed_person, 0.0, 1.0);
  v.Field("few_joints_factor", c.few_joints_factor, 0.0, 100.0);
  v.Field("false_person_hz", c.false_person_hz, 0.0, 30.0);
  v.Field("noise_share", c.noise_share, 0.0, 1.0);
  v.Field("min_noise_px", c.min_noise_px, 0.0, 100.0);
  v.Field("outlier", c.outlier, 0.0, 1.0);
  v.Field("hidden_found", c.hidden_found, 0.0, 1.0);
  v.Field("fault_seconds", c.fault_seconds, 0.01, 10.0);
}

template <class V>
void Describe(V& v, KeypointTiming& c) {
  v.Field("rate_hz", c.rate_hz, 0.0, 30.0);
  v.Field("latency_s", c.latency_s, 0.0, 10.0);
  v.Field("latency_jitter", c.latency_jitter, 0.0, 1.0);
}

}  // namespace posefusion
