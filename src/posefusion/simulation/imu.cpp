#include "posefusion/simulation/imu.h"

#include <cmath>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/indexed_random.h"

namespace posefusion {
namespace {

constexpr int kGyroStream = 411;
constexpr int kAccelerometerStream = 412;
constexpr double kDifferenceS = 1e-3;  ///< step of the numeric derivatives

/// A three-axis sensor's bias that wanders, and its white noise.
class AxisErrors {
 public:
  AxisErrors(int seed, int stream, double bias, double walk, double noise)
      : random_(seed, stream), walk_(walk), noise_(noise), bias_(Draw(bias)) {}

  Eigen::Vector3d Next() {
    bias_ += Draw(walk_);
    return bias_ + Draw(noise_);
  }

 private:
  Eigen::Vector3d Draw(double deviation) {
    Eigen::Vector3d value;
    for (int axis = 0; axis < 3; ++axis) value[axis] = random_.Gaussian(next_++, deviation);
    return value;
  }

  IndexedRandom random_;
  std::int64_t next_ = 0;
  double walk_;
  double noise_;
  Eigen::Vector3d bias_;
};

}  // namespace

std::vector<ImuSample> SimulateImu(const ImuConfig& config,
                                   const std::function<Eigen::Isometry3d(double)>& T_map_imu,
                                   int seed, double seconds) {
  const double interval_s = 1 / config.rate_hz;
  const double bandwidth = std::sqrt(config.rate_hz);
  const double step = std::sqrt(interval_s);
  AxisErrors gyro(seed, kGyroStream, config.gyro_bias_rad_s, config.gyro_bias_walk * step,
                  config.gyro_noise * bandwidth);
  AxisErrors accelerometer(seed, kAccelerometerStream, config.accelerometer_bias_m_s2,
                           config.accelerometer_bias_walk * step,
                           config.accelerometer_noise * bandwidth);
  std::vector<ImuSample> samples;
  const auto num_samples = static_cast<int>(std::floor(seconds * config.rate_hz)) + 1;
  for (int i = 0; i < num_samples; ++i) {
    const double t = i * interval_s;
    const Eigen::Isometry3d before = T_map_imu(t - kDifferenceS);
    const Eigen::Isometry3d now = T_map_imu(t);
    const Eigen::Isometry3d after = T_map_imu(t + kDifferenceS);
    const Eigen::Vector3d acceleration_map =
        (before.translation() - 2 * now.translation() + after.translation()) /
            (kDifferenceS * kDifferenceS) +
        Eigen::Vector3d(0, 0, kGravityMS2);
    const Eigen::Vector3d turn = LogSO3(before.linear().transpose() * after.linear());
    samples.push_back({t, turn / (2 * kDifferenceS) + gyro.Next(),
                       now.linear().transpose() * acceleration_map + accelerometer.Next()});
  }
  return samples;
}

}  // namespace posefusion
