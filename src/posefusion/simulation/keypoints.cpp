#include "posefusion/simulation/keypoints.h"

#include <algorithm>
#include <cmath>

#include "posefusion/simulation/indexed_random.h"
#include "posefusion/simulation/renderer.h"
#include "posefusion/skeleton/keypoint_rate.h"

namespace posefusion {
namespace {

constexpr int kMissStream = 500;   ///< + person
constexpr int kJointStream = 520;  ///< + person
constexpr int kNoiseStream = 540;  ///< + person
constexpr int kFalseStream = 560;
constexpr int kLatencyStream = 580;
constexpr int kLabelWindow = 2;  ///< pixels around a joint that may show the person
constexpr int kFewJoints = 6;
constexpr double kHzOfStamps = 1e6;  ///< noise depends on the time in microseconds

using Joints = std::array<TrueJoint, kNumCocoJoints>;

bool ShowsPerson(const cv::Mat& labels, double u, double v, int person) {
  const int centre_u = static_cast<int>(std::lround(u));
  const int centre_v = static_cast<int>(std::lround(v));
  if (centre_u < 0 || centre_v < 0 || centre_u >= labels.cols || centre_v >= labels.rows) {
    return false;
  }
  const cv::Rect window = cv::Rect(centre_u - kLabelWindow, centre_v - kLabelWindow,
                                   2 * kLabelWindow + 1, 2 * kLabelWindow + 1) &
                          cv::Rect(0, 0, labels.cols, labels.rows);
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      if (labels.at<std::uint8_t>(y, x) == kLabelPerson + person) return true;
    }
  }
  return false;
}

/// Height of the person's joints in the image, pixels.
double HeightOf(const Joints& joints) {
  double top = 1e9;
  double bottom = -1e9;
  for (const TrueJoint& joint : joints) {
    if (joint.depth_m <= 0) continue;
    top = std::min(top, joint.v);
    bottom = std::max(bottom, joint.v);
  }
  return std::max(bottom - top, 0.0);
}

/// The joint on the other side of the body; joints on neither side are their own.
std::size_t OtherSide(std::size_t joint) {
  constexpr std::array<std::size_t, kNumCocoJoints> kOther = {
      kNose,       kNeck,       kLeftShoulder, kLeftElbow, kLeftWrist, kRightShoulder,
      kRightElbow, kRightWrist, kLeftHip,      kLeftKnee,  kLeftAnkle, kRightHip,
      kRightKnee,  kRightAnkle, kLeftEye,      kRightEye,  kLeftEar,   kRightEar};
  return kOther[joint];
}

/// Number of the stretch of time that a time lies in; stretches of different people begin at
/// different times.
std::int64_t StretchOf(double time_s, double stretch_s, double offset) {
  return static_cast<std::int64_t>(std::floor(time_s / stretch_s + offset)) + 1;
}

std::int64_t MicrosecondsOf(double time_s) { return std::llround(time_s * kHzOfStamps); }

bool IsInside(const CameraModel& camera, const Joint& point) {
  return point.u >= 0 && point.v >= 0 && point.u <= static_cast<float>(camera.width - 1) &&
         point.v <= static_cast<float>(camera.height - 1);
}

/// A person found, with the joints' faults; empty when missed.
class Detection {
 public:
  Detection(const TruePerson& truth, const KeypointFaultConfig& config, double time_s, int seed)
      : truth_(truth),
        config_(config),
        miss_(seed, kMissStream + truth.person),
        joint_(seed, kJointStream + truth.person),
        noise_(seed, kNoiseStream + truth.person),
        stretch_(StretchOf(time_s, config.fault_seconds, miss_.Uniform(-1))),
        moment_(kNumCocoJoints * 8 * MicrosecondsOf(time_s)),
        noise_px_(std::max(config.min_noise_px, config.noise_share * HeightOf(truth.joints))) {}

  bool IsMissed() const {
    const bool few = truth_.NumVisible() < kFewJoints;
    return miss_.Uniform(stretch_) < config_.missed_person * (few ? config_.few_joints_factor : 1);
  }

  Skeleton Keypoints(const CameraModel& camera) const {
    Skeleton keypoints{};
    for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
      if (!IsFound(i)) continue;
      const Joint point = Place(i);
      if (IsInside(camera, point)) keypoints[i] = point;
    }
    return keypoints;
  }

 private:
  std::int64_t IndexOf(std::size_t joint, int what) const {
    return moment_ + static_cast<std::int64_t>(8 * joint) + what;
  }

  /// Half of the misses last a stretch of time, half are of one frame.
  bool IsFound(std::size_t i) const {
    const TrueJoint& joint = truth_.joints[i];
    if (joint.depth_m <= 0) return false;
    const double lasting = joint_.Uniform(stretch_ * kNumCocoJoints + static_cast<std::int64_t>(i));
    if (!joint.visible) return lasting < config_.hidden_found;
    return lasting >= 0.5 * config_.missed_joint &&
           noise_.Uniform(IndexOf(i, 0)) >= 0.5 * config_.missed_joint;
  }

  Joint Place(std::size_t i) const {
    const bool swapped = noise_.Uniform(IndexOf(i, 1)) < config_.outlier;
    const TrueJoint& joint = truth_.joints[swapped ? OtherSide(i) : i];
    const double deviation = noise_px_ * (joint.visible ? 1 : 2.5);
    Joint point;
    point.u = static_cast<float>(joint.u + noise_.Gaussian(IndexOf(i, 2), deviation));
    point.v = static_cast<float>(joint.v + noise_.Gaussian(IndexOf(i, 3), deviation));
    const double certainty = noise_.Uniform(IndexOf(i, 4));
    point.p = static_cast<float>(joint.visible ? 0.55 + 0.4 * certainty : 0.1 + 0.3 * certainty);
    return point;
  }

  const TruePerson& truth_;
  const KeypointFaultConfig& config_;
  IndexedRandom miss_;
  IndexedRandom joint_;
  IndexedRandom noise_;
  std::int64_t stretch_;
  std::int64_t moment_;
  double noise_px_;
};

/// A stretched-out figure in a place of the image that depends on the stretch of time.
std::optional<Skeleton> FalsePerson(const KeypointFaultConfig& config, const CameraModel& camera,
                                    double time_s, int seed) {
  const IndexedRandom random(seed, kFalseStream);
  const std::int64_t stretch = 100 * StretchOf(time_s, config.fault_seconds, 0);
  if (random.Uniform(stretch) >= config.false_person_hz * config.fault_seconds) return std::nullopt;
  // Joints of a standing figure of height 1, x to the right, y down.
  constexpr std::array<std::array<double, 2>, kNumCocoJoints> kFigure = {{{0, 0.08},
                                                                          {0, 0.18},
                                                                          {-0.10, 0.18},
                                                                          {-0.14, 0.33},
                                                                          {-0.15, 0.47},
                                                                          {0.10, 0.18},
                                                                          {0.14, 0.33},
                                                                          {0.15, 0.47},
                                                                          {-0.06, 0.50},
                                                                          {-0.06, 0.73},
                                                                          {-0.06, 0.95},
                                                                          {0.06, 0.50},
                                                                          {0.06, 0.73},
                                                                          {0.06, 0.95},
                                                                          {-0.02, 0.06},
                                                                          {0.02, 0.06},
                                                                          {-0.05, 0.08},
                                                                          {0.05, 0.08}}};
  const double height = camera.height * random.Uniform(stretch + 1, 0.25, 0.7);
  const double left = camera.width * random.Uniform(stretch + 2, 0.1, 0.9);
  const double top = (camera.height - height) * random.Uniform(stretch + 3);
  Skeleton person{};
  for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
    const std::int64_t index = stretch + 10 + 3 * static_cast<std::int64_t>(i);
    if (random.Uniform(index) < 0.5) continue;
    const Joint point = {static_cast<float>(left + height * kFigure[i][0]),
                         static_cast<float>(top + height * kFigure[i][1]),
                         static_cast<float>(random.Uniform(index + 1, 0.1, 0.5))};
    if (IsInside(camera, point)) person[i] = point;
  }
  return person;
}

}  // namespace

int TruePerson::NumVisible() const {
  return static_cast<int>(std::count_if(joints.begin(), joints.end(),
                                        [](const TrueJoint& joint) { return joint.visible; }));
}

std::vector<TruePerson> ProjectPeople(const World& world, const CameraModel& camera,
                                      const Eigen::Isometry3d& T_map_camera, double time_s,
                                      const cv::Mat& labels) {
  std::vector<TruePerson> people;
  const Eigen::Isometry3d T_camera_map = T_map_camera.inverse();
  for (int i = 0; i < world.num_people(); ++i) {
    const PersonPose pose = world.PersonAt(i, time_s);
    if (!pose.present) continue;
    TruePerson person;
    person.person = i;
    for (std::size_t j = 0; j < kNumCocoJoints; ++j) {
      const Eigen::Vector3d p_camera = T_camera_map * pose.joints[j];
      if (p_camera.z() <= 0) continue;
      const Eigen::Vector2d pixel = camera.Project(p_camera);
      person.joints[j] = {pixel.x(), pixel.y(), p_camera.z(),
                          ShowsPerson(labels, pixel.x(), pixel.y(), i)};
    }
    if (person.NumVisible() > 0) people.push_back(person);
  }
  return people;
}

std::vector<Skeleton> DetectPeople(const std::vector<TruePerson>& truth,
                                   const KeypointFaultConfig& config, const CameraModel& camera,
                                   double time_s, int seed) {
  std::vector<Skeleton> people;
  for (const TruePerson& person : truth) {
    const Detection detection(person, config, time_s, seed);
    if (!detection.IsMissed()) people.push_back(detection.Keypoints(camera));
  }
  if (const auto person = FalsePerson(config, camera, time_s, seed)) people.push_back(*person);
  return people;
}

std::vector<Skeleton> PerfectKeypoints(const std::vector<TruePerson>& truth) {
  std::vector<Skeleton> people;
  for (const TruePerson& person : truth) {
    Skeleton keypoints{};
    for (std::size_t i = 0; i < kNumCocoJoints; ++i) {
      const TrueJoint& joint = person.joints[i];
      if (joint.visible) {
        keypoints[i] = {static_cast<float>(joint.u), static_cast<float>(joint.v), 1};
      }
    }
    people.push_back(keypoints);
  }
  return people;
}

std::optional<double> KeypointArrival(const KeypointTiming& timing, double time_s,
                                      double interval_s, int seed) {
  if (!IsDue(time_s, time_s - interval_s, timing.rate_hz)) return std::nullopt;
  const double jitter = IndexedRandom(seed, kLatencyStream).Uniform(MicrosecondsOf(time_s), -1, 1);
  return time_s + timing.latency_s * (1 + timing.latency_jitter * jitter);
}

}  // namespace posefusion
