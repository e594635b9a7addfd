// Cuts people out of the frames of a folder that have keypoints, for tuning human_removal.yaml.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "posefusion/common/atomic_file.h"
#include "posefusion/config/config.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/segmentation/mask_overlay.h"
#include "posefusion/segmentation/person_cutter.h"
#include "posefusion/skeleton/openpose_json.h"
#include "tools/tool_main.h"

namespace {

namespace fs = std::filesystem;
namespace pf = posefusion;

struct Arguments {
  std::string folder;
  std::string keypoints;
  std::string out;
  std::string config_file;
  std::string backend;
  bool overlays = false;
};

pf::HumanRemovalConfig LoadConfig(const Arguments& arguments) {
  pf::HumanRemovalConfig config;
  if (!arguments.config_file.empty()) {
    YAML::Node node = pf::LoadYamlFile(arguments.config_file);
    node.remove("ros");  // belongs to the nodelet
    pf::ApplyYaml(node, "human_removal", config);
  }
  if (arguments.backend == "pcl") config.min_cut.backend = pf::MinCutBackend::kPcl;
  if (arguments.backend == "grid") config.min_cut.backend = pf::MinCutBackend::kGrid;
  return config;
}

void WriteOverlay(const pf::RgbdFrame& frame, const cv::Mat& mask, const pf::PersonCutter& cutter,
                  const std::string& path) {
  cv::Mat picture;
  cv::cvtColor(pf::DrawCut(frame.rgb, mask, cutter), picture, cv::COLOR_RGB2BGR);
  pf::WriteImage(picture, path);
}

void PrintTimes(std::vector<double>& times_ms) {
  if (times_ms.empty()) {
    std::puts("no frame has keypoints");
    return;
  }
  std::sort(times_ms.begin(), times_ms.end());
  std::printf("%zu frames cut, %.2f ms per frame (median), %.2f ms (longest)\n", times_ms.size(),
              times_ms[times_ms.size() / 2], times_ms.back());
}

void Run(const Arguments& arguments) {
  pf::PersonCutter cutter(LoadConfig(arguments));
  pf::TumFolderSource source(arguments.folder);
  fs::create_directories(arguments.out + "/masks");
  if (arguments.overlays) fs::create_directories(arguments.out + "/overlays");
  std::vector<double> times_ms;
  cv::Mat mask;
  while (const auto frame = source.Next()) {
    const std::string name = pf::FormatStamp(frame->stamp_ns);
    const std::string json = arguments.keypoints + "/" + name + ".json";
    if (!fs::exists(json)) continue;
    pf::Skeletons skeletons;
    skeletons.stamp_ns = frame->stamp_ns;
    skeletons.people = pf::ReadOpenPoseJson(pf::ReadWholeFile(json), json).people;
    const auto start = std::chrono::steady_clock::now();
    cutter.Cut(*frame, skeletons, mask);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    times_ms.push_back(time.count());
    pf::WriteImage(mask, arguments.out + "/masks/" + name + ".png");
    if (!arguments.overlays) continue;
    WriteOverlay(*frame, mask, cutter, arguments.out + "/overlays/" + name + ".jpg");
  }
  PrintTimes(times_ms);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Cuts people out of the frames of a folder that have keypoints.");
  Arguments arguments;
  app.add_option("folder", arguments.folder, "folder in TUM format")->required();
  app.add_option("--keypoints", arguments.keypoints,
                 "folder with OpenPose JSON <stamp>.json (default: keypoints/ of the folder)");
  app.add_option("--out", arguments.out, "folder for masks/ and overlays/")->required();
  app.add_option("--config", arguments.config_file, "yaml file like config/human_removal.yaml");
  app.add_option("--backend", arguments.backend, "min-cut backend, instead of the configured one")
      ->check(CLI::IsMember({"grid", "pcl"}));
  app.add_flag("--overlays", arguments.overlays, "draw masks and seeds over the pictures");
  return posefusion::RunTool(app, argc, argv, "cut_people", [&] {
    if (arguments.keypoints.empty()) arguments.keypoints = arguments.folder + "/keypoints";
    Run(arguments);
    return 0;
  });
}
