// Finds people in the colour images of a sequence: OpenPose JSON out, one file per image.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "interrupt.h"
#include "posefusion/common/atomic_file.h"
#include "posefusion/config/config.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/skeleton/openpose_json.h"
#include "posefusion/skeleton/pose_network.h"
#include "posefusion/skeleton/stamp_rate_limit.h"
#include "progress.h"
#include "skeleton_picture.h"
#include "tools/tool_main.h"

namespace {

namespace fs = std::filesystem;
namespace pf = posefusion;

struct Arguments {
  std::string source;
  std::string out;
  std::string pictures;
  std::string config_file;
  std::string model;
  std::string model_config;
  std::vector<int> input_size_px;
  int num_threads = 2;
  int max_frames = 0;
  double rate_hz = 0;
  bool force = false;
};

void AddOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("SOURCE", arguments.source, "folder in TUM format")->required();
  app.add_option("--out", arguments.out,
                 "folder for <stamp>.json, such as SOURCE/keypoints (made if missing)")
      ->required();
  app.add_option("--model", arguments.model, "weights: .caffemodel or .pb");
  app.add_option("--model-config", arguments.model_config, "the .prototxt of a .caffemodel");
  app.add_option("--input-size", arguments.input_size_px, "network input, WIDTH HEIGHT [px]")
      ->expected(2);
  app.add_option("--config", arguments.config_file, "yaml file like config/pose_network.yaml");
  app.add_option("--rate", arguments.rate_hz, "images per second at most (default: all)")
      ->check(CLI::PositiveNumber);
  app.add_option("--pictures", arguments.pictures, "folder for images with the skeletons drawn in");
  app.add_option("--max-frames", arguments.max_frames, "ends after so many frames")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.num_threads, "threads to use")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_flag("--force", arguments.force, "replaces the keypoints that the folder holds");
}

pf::PoseNetworkConfig NetworkConfig(const Arguments& arguments) {
  pf::PoseNetworkConfig config;
  if (!arguments.config_file.empty()) {
    pf::ApplyYaml(pf::LoadYamlFile(arguments.config_file), arguments.config_file, config);
  }
  if (!arguments.model.empty()) {
    config.model = arguments.model;
    config.model_config = arguments.model_config;
  }
  if (!arguments.input_size_px.empty()) {
    config.input_width_px = arguments.input_size_px[0];
    config.input_height_px = arguments.input_size_px[1];
  }
  config.num_threads = arguments.num_threads;
  if (arguments.rate_hz > 0) config.rate_hz = arguments.rate_hz;
  return config;
}

/// Makes the folder, without the keypoints of an earlier run.
void PrepareKeypointFolder(const std::string& folder, bool force) {
  fs::create_directories(folder);
  if (fs::is_empty(folder)) return;
  if (!force) throw std::runtime_error(folder + " is not empty (--force replaces its keypoints)");
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") old.push_back(entry.path());
  }
  for (const fs::path& path : old) fs::remove(path);
}

void WritePicture(const pf::RgbdFrame& frame, const std::vector<pf::Skeleton>& people,
                  const std::string& path) {
  cv::Mat picture;
  cv::cvtColor(frame.rgb, picture, cv::COLOR_RGB2BGR);
  pf::DrawSkeletons(people, picture);
  pf::WriteImage(picture, path);
}

/// The next frame; one that cannot be read is left out and said so.
std::optional<pf::RgbdFrame> NextReadable(pf::FrameSource& frames, pf::Progress& progress,
                                          int& num_bad) {
  while (true) {
    try {
      return frames.Next();
    } catch (const std::runtime_error& error) {
      ++num_bad;
      progress.Print(std::string("detect_keypoints: ") + error.what());
    }
  }
}

struct Figures {
  int images = 0;
  int with_people = 0;
  int bad = 0;
};

Figures DetectAll(const Arguments& arguments, pf::PoseNetwork& network, pf::FrameSource& frames) {
  pf::Progress progress("detect_keypoints", frames.NumFrames());
  pf::StampRateLimit limit(network.config().rate_hz);
  Figures figures;
  int num_seen = 0;
  while (const auto frame = NextReadable(frames, progress, figures.bad)) {
    if (pf::interrupted) break;
    progress.Update(++num_seen);
    if (!limit.Accept(frame->stamp_ns)) continue;
    const std::vector<pf::Skeleton> people = network.Detect(frame->rgb);
    const std::string name = pf::FormatStamp(frame->stamp_ns);
    pf::WriteFileAtomically(arguments.out + "/" + name + ".json", pf::ToOpenPoseJson(people));
    if (!arguments.pictures.empty()) {
      WritePicture(*frame, people, arguments.pictures + "/" + name + ".png");
    }
    ++figures.images;
    if (!people.empty()) ++figures.with_people;
  }
  progress.Finish();
  return figures;
}

int Run(const Arguments& arguments) {
  pf::PoseNetwork network(NetworkConfig(arguments));
  pf::TumFolderOptions options;
  options.max_frames = arguments.max_frames;
  pf::PrefetchedSource frames(std::make_unique<pf::TumFolderSource>(arguments.source, options));
  PrepareKeypointFolder(arguments.out, arguments.force);
  if (!arguments.pictures.empty()) fs::create_directories(arguments.pictures);
  pf::CatchInterrupts();
  const Figures figures = DetectAll(arguments, network, frames);
  std::printf("%d images, people in %d; keypoints in %s\n", figures.images, figures.with_people,
              arguments.out.c_str());
  if (pf::interrupted) std::fprintf(stderr, "detect_keypoints: interrupted, the rest is missing\n");
  return figures.bad == 0 && !pf::interrupted ? 0 : pf::kExitFailure;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds people in the colour images of a sequence and writes OpenPose JSON.");
  Arguments arguments;
  AddOptions(app, arguments);
  return posefusion::RunTool(app, argc, argv, "detect_keypoints", [&] { return Run(arguments); });
}
