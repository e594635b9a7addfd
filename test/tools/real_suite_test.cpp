// A tiny suite with the real programs: a rendered room is mapped and compared with its truth.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/mesh_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "test/support/program_run.h"
#include "test/support/rendered_source.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::RenderedRoom;
using testing::SceneBox;

constexpr int kNumFrames = 120;
constexpr StampNs kFirstStampNs = 1'000'000'000;
constexpr double kDepthScale = 5000;
/// Mean of the surface error without noise of the sensor: what quantised depth and the tracker
/// leave.
constexpr double kMaxErrorM = 0.01;

/// Adds the box as twelve triangles.
void AddBox(const SceneBox& box, TriangleMesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                               (i & 4 ? box.max : box.min).z());
  }
  constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& face : kFaces) {
    mesh.triangles.emplace_back(first + face[0], first + face[1], first + face[2]);
    mesh.triangles.emplace_back(first + face[0], first + face[2], first + face[3]);
  }
}

void WriteFrame(const RgbdFrame& frame, const std::string& folder) {
  const std::string name = FormatStamp(frame.stamp_ns) + ".png";
  cv::Mat bgr;
  cv::cvtColor(frame.rgb, bgr, cv::COLOR_RGB2BGR);
  cv::Mat depth;
  frame.depth_m.convertTo(depth, CV_16U, kDepthScale);
  cv::imwrite(folder + "/rgb/" + name, bgr);
  cv::imwrite(folder + "/depth/" + name, depth);
  for (const char* kind : {"rgb", "depth"}) {
    std::ofstream list(folder + "/" + kind + ".txt", std::ios::app);
    list << FormatStamp(frame.stamp_ns) << " " << kind << "/" << name << "\n";
  }
}

/// The rendered walk as a folder with its truth: true poses at 200 Hz and the room as a mesh.
void WriteDataset(const std::string& folder) {
  std::filesystem::create_directories(folder + "/rgb");
  std::filesystem::create_directories(folder + "/depth");
  WriteFileAtomically(folder + "/camera.yaml",
                      "{width: 160, height: 120, fx: 138.6, fy: 138.6, cx: 79.5, cy: 59.5, "
                      "depth_scale: 5000}\n");
  testing::RenderedSource source(kNumFrames, kFirstStampNs);
  Trajectory truth;
  while (const auto frame = source.Next()) {
    const auto i = static_cast<int>(truth.size());
    truth.push_back({frame->stamp_ns, testing::SwayingPose(i)});
    WriteFrame(*frame, folder);
  }
  WriteTrajectory(truth, folder + "/groundtruth.txt");
  TriangleMesh mesh;
  const RenderedRoom room = RenderedRoom::Furnished();
  AddBox(room.room(), mesh);
  for (const SceneBox& box : room.boxes()) AddBox(box, mesh);
  WriteMesh(mesh, folder + "/world.ply");
}

TEST(RealSuite, MapsARoomAndFindsItWhereItIs) {
  const TemporaryFolder folder;
  WriteDataset(folder / "data");
  WriteFileAtomically(folder / "list.yaml", "runs: [{name: room, sources: ['" + (folder / "data") +
                                                "'], presets: [ef]}]");
  const ProgramRun run =
      RunProgram(EVALUATE_SUITE, (folder / "list.yaml") + " --out " + (folder / "out"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto suite = nlohmann::json::parse(ReadWholeFile(folder / "out/suite.json"));
  const auto& figures = suite.at("jobs").at(0).at("figures");
  EXPECT_EQ(figures.at("report.frames.total"), kNumFrames);
  EXPECT_LT(figures.at("trajectory.ate.translation.rmse_m").get<double>(), kMaxErrorM);
  EXPECT_GT(figures.at("map.surface_error.near.count").get<int>(), 1000);
  EXPECT_LT(figures.at("map.surface_error.near.mean_m").get<double>(), kMaxErrorM);
  EXPECT_GT(figures.at("map.completeness.ratio").get<double>(), 0.5);
  EXPECT_LT(figures.at("map.ghosts.off_surface.share").get<double>(), 0.01);
}

}  // namespace
}  // namespace posefusion
