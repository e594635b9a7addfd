// Writes what the learned data term sees of the cells of simulated frames, with the truth, for
// scripts/train_person_trees.py.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/segmentation/human_remover.h"
#include "posefusion/skeleton/openpose_json.h"
#include "tools/tool_main.h"

namespace {

namespace fs = std::filesystem;
namespace pf = posefusion;

constexpr int kRimPx = 3;         ///< at the border of people, where depth and labels disagree
constexpr int kPersonLabel = 10;  ///< labels from here on are people's

struct Arguments {
  std::vector<std::string> folders;
  std::string out;
  int every = 8;
};

/// CV_8UC1: 1 = person, 0 = not, kRim = too near to the border to say.
constexpr std::uint8_t kRim = 255;

cv::Mat TruthOf(const std::string& label_file) {
  const cv::Mat labels = cv::imread(label_file, cv::IMREAD_UNCHANGED);
  if (labels.empty()) throw std::runtime_error(label_file + ": cannot be read");
  const cv::Mat people = labels >= kPersonLabel;
  const int size = 2 * kRimPx + 1;
  cv::Mat inner;
  cv::Mat outer;
  cv::erode(people, inner, cv::Mat::ones(size, size, CV_8UC1));
  cv::dilate(people, outer, cv::Mat::ones(size, size, CV_8UC1));
  cv::Mat truth(people.size(), CV_8UC1, cv::Scalar(kRim));
  truth.setTo(1, inner);
  truth.setTo(0, outer == 0);
  return truth;
}

std::vector<pf::Skeletons> KeypointsOf(const std::string& folder, pf::StampNs stamp_ns) {
  const std::string file = folder + "/keypoints/" + pf::FormatStamp(stamp_ns) + ".json";
  if (!fs::exists(file)) return {};
  pf::Skeletons skeletons;
  skeletons.stamp_ns = stamp_ns;
  skeletons.people = pf::ReadOpenPoseJson(pf::ReadWholeFile(file), file).people;
  return {skeletons};
}

/// Rows of float32: the truth (0 or 1), then the features.
void Dump(const std::string& folder, int every, std::ofstream& out) {
  pf::HumanRemovalConfig config;
  config.min_cut.data_term = pf::DataTerm::kPenalty;  // what was learned before is left out
  pf::HumanRemover remover(config);
  pf::TumFolderSource source(folder);
  cv::Mat truth;
  remover.SetOnCell([&](const cv::Point& cell, const pf::CellFeatures& features) {
    if (truth.empty()) return;
    const int half = config.cells.size_px / 2;
    const cv::Point pixel = config.cells.size_px * cell + cv::Point(half, half);
    if (!cv::Rect({0, 0}, truth.size()).contains(pixel)) return;
    const std::uint8_t label = truth.at<std::uint8_t>(pixel);
    if (label == kRim) return;
    const auto is_person = static_cast<float>(label);
    out.write(reinterpret_cast<const char*>(&is_person), sizeof(is_person));
    out.write(reinterpret_cast<const char*>(features.data()), sizeof(features));
  });
  for (int i = 0; const auto frame = source.Next(); ++i) {
    const std::string label_file = folder + "/labels/" + pf::FormatStamp(frame->stamp_ns) + ".png";
    truth = i % every == 0 && fs::exists(label_file) ? TruthOf(label_file) : cv::Mat();
    remover.Process(*frame, KeypointsOf(folder, frame->stamp_ns));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes the cells of simulated frames, with the truth, for learning who is person.");
  Arguments arguments;
  app.add_option("folders", arguments.folders, "folders that `simulate` wrote")->required();
  app.add_option("--out", arguments.out, "file of float32 rows: truth, features")->required();
  app.add_option("--every", arguments.every, "take one frame of so many")
      ->check(CLI::PositiveNumber);
  return posefusion::RunTool(app, argc, argv, "dump_person_cells", [&] {
    std::ofstream out(arguments.out, std::ios::binary);
    for (const std::string& folder : arguments.folders) Dump(folder, arguments.every, out);
    out.close();
    if (!out) throw std::runtime_error(arguments.out + ": cannot be written");
    return 0;
  });
}
