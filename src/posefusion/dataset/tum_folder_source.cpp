#include "posefusion/dataset/tum_folder_source.h"

#include <filesystem>
#include <stdexcept>

#include "posefusion/common/association.h"
#include "posefusion/common/text_lines.h"
#include "posefusion/dataset/image_file.h"
#include "posefusion/image/depth_units.h"

namespace posefusion {
namespace {

/// One of rgb.txt and depth.txt.
struct ImageList {
  std::vector<StampNs> stamps_ns;
  std::vector<std::string> paths;
};

std::vector<TextLine> ReadListLines(const std::string& path) {
  try {
    return ReadTextLines(path);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

ImageList ReadImageList(const std::filesystem::path& folder, const std::string& name) {
  const std::string path = folder / name;
  ImageList list;
  for (const TextLine& line : ReadListLines(path)) {
    const auto stamp_ns = ParseStamp(line.columns.front());
    if (!stamp_ns || line.columns.size() != 2) {
      throw std::invalid_argument(LineName(path, line) + ": expected 'stamp filename'");
    }
    list.stamps_ns.push_back(*stamp_ns);
    list.paths.push_back(folder / line.columns[1]);
  }
  if (list.paths.empty()) throw std::invalid_argument(path + ": lists no images");
  return list;
}

void CheckSize(const cv::Mat& image, const CameraModel& camera, const std::string& path) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::runtime_error(path + ": image has " + std::to_string(image.cols) + "x" +
                           std::to_string(image.rows) + " pixels, camera.yaml says " +
                           std::to_string(camera.width) + "x" + std::to_string(camera.height));
}

}  // namespace

TumFolderSource::TumFolderSource(const std::string& folder, const TumFolderOptions& options) {
  if (!std::filesystem::is_directory(folder)) {
    throw std::invalid_argument(folder + ": no such folder");
  }
  camera_file_ = ReadCameraFile(std::filesystem::path(folder) / "camera.yaml");
  ListEntries(folder, options);
}

void TumFolderSource::ListEntries(const std::string& folder, const TumFolderOptions& options) {
  const ImageList rgb = ReadImageList(folder, "rgb.txt");
  const ImageList depth = ReadImageList(folder, "depth.txt");
  const auto matches = AssociateStamps(rgb.stamps_ns, depth.stamps_ns, options.max_difference_s);
  if (matches.empty()) {
    throw std::invalid_argument(folder + ": no stamps of rgb.txt and depth.txt are within " +
                                std::to_string(options.max_difference_s) + " s");
  }
  const StampNs start_ns = rgb.stamps_ns[matches.front().first] + StampFromSeconds(options.start_s);
  for (const StampMatch& match : matches) {
    if (rgb.stamps_ns[match.first] < start_ns) continue;
    if (options.max_frames > 0 && static_cast<int>(entries_.size()) == options.max_frames) break;
    entries_.push_back({static_cast<int>(match.first), rgb.stamps_ns[match.first],
                        depth.stamps_ns[match.second], rgb.paths[match.first],
                        depth.paths[match.second]});
  }
}

std::optional<RgbdFrame> TumFolderSource::Next() {
  if (next_ == entries_.size()) return std::nullopt;
  const Entry& entry = entries_[next_++];
  RgbdFrame frame;
  frame.stamp_ns = entry.rgb_stamp_ns;
  frame.depth_stamp_ns = entry.depth_stamp_ns;
  frame.index = entry.rgb_index;
  frame.camera = camera_file_.camera;
  frame.rgb = ReadColourImage(entry.rgb_path);
  CheckSize(frame.rgb, frame.camera, entry.rgb_path);
  const cv::Mat raw_depth = ReadDepthImage(entry.depth_path);
  CheckSize(raw_depth, frame.camera, entry.depth_path);
  frame.depth_m = DepthToMetres(raw_depth, entry.depth_path, camera_file_.depth_scale);
  return frame;
}

}  // namespace posefusion
