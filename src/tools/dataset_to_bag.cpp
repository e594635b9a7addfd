#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "posefusion_ros/bag_writer.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/tool_main.h"

namespace {

constexpr const char* kCameraFrame = "camera_rgb_optical_frame";

/// Writes the keypoints of a frame, if there are any, to be played when they arrive.
/// @throws std::runtime_error naming a file that cannot be used.
void WriteKeypoints(const posefusion::RgbdFrame& frame, posefusion::SkeletonSource& keypoints,
                    posefusion::BagWriter& writer) {
  keypoints.Offer(frame);
  for (const std::string& note : keypoints.TakeNotes()) {
    std::fprintf(stderr, "dataset_to_bag: %s\n", note.c_str());
  }
  constexpr auto kSoonerOrLater = std::numeric_limits<posefusion::StampNs>::max();
  for (const auto& skeletons : keypoints.Take(kSoonerOrLater)) writer.Write(skeletons);
}

/// Returns the number of frames written; what an interrupt cuts off is left out. `keypoints` is a
/// folder or empty.
int WriteBag(const std::string& folder, const std::string& keypoints, const std::string& bag) {
  std::unique_ptr<posefusion::SkeletonFolder> skeletons;
  if (!keypoints.empty()) skeletons = std::make_unique<posefusion::SkeletonFolder>(keypoints);
  posefusion::PrefetchedSource source(std::make_unique<posefusion::TumFolderSource>(folder));
  posefusion::BagWriter writer(bag, kCameraFrame);
  posefusion::Progress progress(bag, source.NumFrames());
  int num_frames = 0;
  while (!posefusion::interrupted) {
    const auto frame = source.Next();
    if (!frame) break;
    writer.Write(*frame);
    if (skeletons) WriteKeypoints(*frame, *skeletons, writer);
    progress.Update(++num_frames);
  }
  if (num_frames == 0) throw std::runtime_error(folder + ": no frame has been written");
  progress.Finish();
  writer.Close();
  if (posefusion::interrupted)
    std::fprintf(stderr, "interrupted; the bag holds what was written\n");
  return num_frames;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Turns a folder in the format of the TUM RGB-D benchmark into a rosbag: colour rgb8, "
      "depth 32FC1 in metres, camera_info with the distortion, stamps as they are.");
  std::string folder;
  std::string bag;
  std::string keypoints;
  app.add_option("DIR", folder, "folder with rgb.txt, depth.txt and camera.yaml")->required();
  app.add_option("FILE.bag", bag, "the bag; replaced if it exists")->required();
  app.add_option("--keypoints", keypoints,
                 "folder of OpenPose's JSON files; written to /skeletons_in at their arrival");
  return posefusion::RunTool(app, argc, argv, "dataset_to_bag", [&] {
    posefusion::CatchInterrupts();
    WriteBag(folder, keypoints, bag);
    return posefusion::interrupted ? posefusion::kExitFailure : 0;
  });
}
