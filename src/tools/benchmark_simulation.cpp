// How fast simulated frames are made: a head that walks around the table among people.

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <iostream>

#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/sensor.h"

namespace posefusion {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Walks around the table and looks across it; two steps in a second shake the head.
class WalkingHead : public HeadMotion {
 public:
  Eigen::Isometry3d T_map_camera(double time_s) const override {
    const double angle = 0.2 * time_s;
    const double step = 2 * M_PI * 1.8 * time_s;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << 1.55 * std::cos(angle), 1.25 * std::sin(angle), 1.4 + 0.012 * std::sin(step);
    const double yaw = angle + M_PI + 0.3 + 0.02 * std::sin(step / 2);
    const double pitch = 0.3 + 0.015 * std::sin(step + 1);
    T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()))
                     .toRotationMatrix();
    Eigen::Matrix3d optical;
    optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    T.linear() = T.linear() * optical;
    return T;
  }
};

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  using namespace posefusion;
  CLI::App app("Measures how fast simulated frames are made");
  WorldConfig config;
  config.humans = 2;
  int frames = 90;
  int threads = 2;
  app.add_option("--humans", config.humans, "number of people");
  app.add_option("--frames", frames, "frames at 30 Hz");
  app.add_option("--threads", threads, "threads");
  CLI11_PARSE(app, argc, argv);
  config.head = std::make_shared<WalkingHead>();
  try {
    auto start = Clock::now();
    const World world(config);
    const ParallelRunner runner(threads);
    std::cout << "world " << SecondsSince(start) << " s\n";
    start = Clock::now();
    Sensor sensor(SensorConfig{}, world);
    std::cout << "light " << SecondsSince(start) << " s\n";
    start = Clock::now();
    const std::clock_t cpu_start = std::clock();
    double blur_px = 0;
    for (int i = 0; i < frames; ++i) {
      blur_px += sensor.Capture(*config.head, i / 30.0, i / 30.0 + 0.005, i, runner).blur_length_px;
    }
    std::cout << "sensor " << frames / SecondsSince(start) << " frames/s, mean blur "
              << blur_px / frames << " px, processor time "
              << 1000.0 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC / frames
              << " ms/frame\n";
    Renderer renderer(world);
    start = Clock::now();
    for (int i = 0; i < frames; ++i) {
      renderer.Render(sensor.camera(), config.head->T_map_camera(i / 30.0), i / 30.0, runner);
    }
    std::cout << "views " << frames / SecondsSince(start) << " frames/s\n";
  } catch (const std::exception& error) {
    std::cerr << "benchmark_simulation: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
