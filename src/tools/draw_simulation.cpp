// Pictures of a simulated run: what the sensor sees at some moments, and the rooms from above.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/dataset/image_file.h"
#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/sensor.h"
#include "posefusion/simulation/simulator.h"
#include "tools/tool_main.h"

namespace posefusion {
namespace {

constexpr double kDepthDelayS = 0.005;
constexpr int kJpegQuality = 85;

struct Arguments {
  SimulationConfig config;
  std::string out;
  std::vector<double> moments_s;
  double step_s = 4;
  bool jpeg = false;
  int num_threads = 2;
};

void Write(const std::string& path, const cv::Mat& rgb) {
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  WriteImage(bgr, path, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
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

/// Draws moments of a run.
class Artist {
 public:
  explicit Artist(const Arguments& arguments)
      : arguments_(arguments),
        config_(CheckedConfig(arguments.config)),
        mover_(MakeMover(config_)),
        world_(MakeWorldConfig(config_, mover_)),
        runner_(arguments.num_threads),
        renderer_(world_),
        sensor_(config_.sensor, world_) {}

  /// Those asked for, or one every step.
  std::vector<double> Moments() const {
    std::vector<double> moments_s = arguments_.moments_s;
    for (const double moment_s : moments_s) {
      if (moment_s >= 0 && moment_s <= config_.seconds) continue;
      throw std::invalid_argument("--at: the run has no " + std::to_string(moment_s) + " s");
    }
    if (!moments_s.empty()) return moments_s;
    for (double t = 0; t < config_.seconds; t += arguments_.step_s) moments_s.push_back(t);
    return moments_s;
  }

  /// All pictures of one moment; prints how much of the view people take, and the motion blur.
  void Draw(double time_s) {
    const SensorFrame frame =
        sensor_.Capture(*mover_.head, time_s, time_s + kDepthDelayS,
                        static_cast<int>(std::lround(time_s * kFrameRateHz)), runner_);
    const RoomKind room = FindPreset(config_.preset).room;
    Save(time_s, "color", frame.frame.rgb);
    Save(time_s, "depth", ColoredDepth(frame.frame.depth_m));
    Save(time_s, "true_depth", ColoredDepth(frame.true_depth_m));
    Save(time_s, "labels", ColoredLabels(frame.labels));
    Save(time_s, "above", FromAbove(renderer_, room, time_s, runner_));
    const double people = cv::mean(frame.labels >= kLabelPerson)[0] / 255;
    std::cout << time_s << " s: " << static_cast<int>(100 * people) << " % people, blur "
              << frame.blur_length_px << " px\n";
  }

 private:
  /// Named by the moment in milliseconds.
  void Save(double time_s, const std::string& what, const cv::Mat& rgb) const {
    const std::string moment = std::to_string(std::lround(time_s * 1000));
    const char* suffix = arguments_.jpeg ? ".jpg" : ".png";
    Write(arguments_.out + "/" + moment + "_" + what + suffix, rgb);
  }

  const Arguments& arguments_;
  SimulationConfig config_;
  Mover mover_;
  World world_;
  ParallelRunner runner_;
  Renderer renderer_;
  Sensor sensor_;
};

void AddOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--preset", arguments.config.preset, "as of simulate")->required();
  app.add_option("--out", arguments.out, "folder for the pictures")->required();
  app.add_option("--humans", arguments.config.humans, "people, 0 to 6")->capture_default_str();
  app.add_option("--seed", arguments.config.seed, "of everything random")->capture_default_str();
  app.add_option("--at", arguments.moments_s, "moments in seconds (default: one every step)")
      ->delimiter(',');
  app.add_option("--step", arguments.step_s, "seconds between pictures")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str();
  app.add_flag("--jpeg", arguments.jpeg, "JPEG instead of PNG");
  app.add_option("--threads", arguments.num_threads, "threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

}  // namespace
}  // namespace posefusion

int main(int argc, char** argv) {
  CLI::App app("Draws moments of a simulated run: what the sensor sees, and the rooms from above.");
  posefusion::Arguments arguments;
  posefusion::AddOptions(app, arguments);
  return posefusion::RunTool(app, argc, argv, "draw_simulation", [&] {
    posefusion::Artist artist(arguments);
    const auto moments_s = artist.Moments();
    std::filesystem::create_directories(arguments.out);
    for (const double moment_s : moments_s) artist.Draw(moment_s);
    return 0;
  });
}
