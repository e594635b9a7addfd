// Pictures of the simulated world: what the sensor sees at some moments, and the rooms from above.

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/sensor.h"

namespace posefusion {
namespace {

/// Walks around the table and looks across it, nodding.
class Visitor : public HeadMotion {
 public:
  Eigen::Isometry3d T_map_camera(double time_s) const override {
    const double angle = 0.25 * time_s - 2.2;
    const Eigen::Vector3d position(1.55 * std::cos(angle), 1.25 * std::sin(angle),
                                   1.35 + 0.015 * std::sin(11 * time_s));
    const Eigen::Vector3d target(-0.9 * std::cos(angle), -0.9 * std::sin(angle),
                                 0.9 + 0.1 * std::sin(2 * time_s));
    return Looking(position, target);
  }

 private:
  static Eigen::Isometry3d Looking(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d forward = (to - from).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() << right, forward.cross(right), forward;
    T.translation() = from;
    return T;
  }
};

void Write(const std::string& path, const cv::Mat& rgb) {
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  if (!cv::imwrite(path, bgr)) throw std::runtime_error(path + ": cannot be written");
}

cv::Mat Colored(const cv::Mat& radiance) {
  cv::Mat root;
  cv::sqrt(cv::max(radiance, 0), root);
  root.convertTo(root, CV_8UC3, 255);
  return root;
}

cv::Mat ColoredDepth(const cv::Mat& depth_m) {
  cv::Mat scaled;
  cv::Mat bgr;
  depth_m.convertTo(scaled, CV_8UC1, 255 / 6.0);
  cv::applyColorMap(scaled, bgr, cv::COLORMAP_TURBO);
  bgr.setTo(0, depth_m == 0);
  cv::cvtColor(bgr, bgr, cv::COLOR_BGR2RGB);
  return bgr;
}

cv::Mat ColoredLabels(const cv::Mat& labels) {
  cv::Mat rgb(labels.size(), CV_8UC3, cv::Scalar(60, 60, 66));
  rgb.setTo(cv::Scalar(250, 210, 60), labels == kLabelMovable);
  for (int i = 0; i < 6; ++i) {
    const cv::Scalar color(80 + (i * 97) % 176, 60 + (i * 151) % 196, 255 - (i * 61) % 200);
    rgb.setTo(color, labels == kLabelPerson + i);
  }
  return rgb;
}

/// The rooms without their ceilings.
cv::Mat FromAbove(Renderer& renderer, RoomKind room, double time_s, const ParallelRunner& runner) {
  constexpr double kHeight = 14;
  const bool lab = room == RoomKind::kLab;
  const double focal = kHeight * (lab ? 140 : 46);
  const CameraModel camera{1240, lab ? 960 : 640, focal, focal, 619.5, lab ? 479.5 : 319.5, {}};
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  T.translation() = lab ? Eigen::Vector3d(0, -0.8, kHeight) : Eigen::Vector3d(13, 0, kHeight);
  return Colored(renderer.Render(camera, T, time_s, runner, kHeight - 2.4).radiance);
}

/// All pictures of one moment; prints how much of the view people take, and the motion blur.
void DrawMoment(const std::string& name, const WorldConfig& config, Renderer& renderer,
                Sensor& sensor, double time_s, const ParallelRunner& runner) {
  const SensorFrame frame =
      sensor.Capture(*config.head, time_s, time_s + 0.005, static_cast<int>(time_s * 30), runner);
  Write(name + "_color.png", frame.frame.rgb);
  Write(name + "_depth.png", ColoredDepth(frame.frame.depth_m));
  Write(name + "_true_depth.png", ColoredDepth(frame.true_depth_m));
  Write(name + "_labels.png", ColoredLabels(frame.labels));
  Write(name + "_above.png", FromAbove(renderer, config.room, time_s, runner));
  const double people = cv::mean(frame.labels >= kLabelPerson)[0] / 255;
  std::cout << time_s << " s: " << static_cast<int>(100 * people) << " % people, blur "
            << frame.blur_length_px << " px\n";
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  using namespace posefusion;
  CLI::App app("Draws pictures of the simulated world");
  WorldConfig config;
  config.humans = 3;
  config.head = std::make_shared<Visitor>();
  std::string out;
  double step_s = 4;
  bool corridor = false;
  int threads = 2;
  app.add_option("--out", out, "folder for the pictures")->required();
  app.add_option("--humans", config.humans, "number of people");
  app.add_option("--seed", config.seed, "of everything random");
  app.add_option("--seconds", config.seconds, "length of the run");
  app.add_option("--step", step_s, "seconds between pictures");
  app.add_option("--threads", threads, "threads");
  app.add_flag("--corridor", corridor, "the corridor instead of the room");
  CLI11_PARSE(app, argc, argv);
  if (corridor) config.room = RoomKind::kCorridor;
  try {
    std::filesystem::create_directories(out);
    const World world(config);
    const ParallelRunner runner(threads);
    Renderer renderer(world);
    Sensor sensor(SensorConfig{}, world);
    for (double t = 0; t < config.seconds; t += step_s) {
      DrawMoment(out + "/" + std::to_string(static_cast<int>(std::lround(t * 10))), config,
                 renderer, sensor, t, runner);
    }
  } catch (const std::exception& error) {
    std::cerr << "draw_simulation: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
