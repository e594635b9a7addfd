#pragma once

#include <string>
#include <vector>

#include "posefusion/dataset/camera_file.h"
#include "posefusion/dataset/frame_source.h"

namespace posefusion {

struct TumFolderOptions {
  double start_s = 0;              ///< leaves out frames earlier than this after the first
  int max_frames = 0;              ///< ends after so many frames; 0 = all
  double max_difference_s = 0.02;  ///< between the stamps of colour and depth of one frame
};

/// Frames of a folder in the format of the TUM RGB-D benchmark (Sturm 2012): rgb.txt and depth.txt
/// with lines `stamp filename`, images (colour PNG or JPEG, depth 16-bit PNG), and camera.yaml (see
/// ReadCameraFile). Colour and depth are paired one to one by AssociateStamps; the frames come in
/// the order of the colour stamps. Not thread-safe; PrefetchedSource decodes ahead.
class TumFolderSource : public FrameSource {
 public:
  /// @throws std::invalid_argument naming the file (and line) for a missing folder or list, a
  /// malformed line, a bad camera.yaml, or lists without a common stamp.
  explicit TumFolderSource(const std::string& folder, const TumFolderOptions& options = {});

  std::optional<RgbdFrame> Next() override;
  std::optional<int> NumFrames() const override { return static_cast<int>(entries_.size()); }

  /// Camera of all frames, with the distortion that they have.
  const CameraModel& camera() const { return camera_file_.camera; }

 private:
  struct Entry {
    int rgb_index = 0;  ///< in rgb.txt
    StampNs rgb_stamp_ns = 0;
    StampNs depth_stamp_ns = 0;
    std::string rgb_path;
    std::string depth_path;
  };

  void ListEntries(const std::string& folder, const TumFolderOptions& options);

  CameraFile camera_file_;
  std::vector<Entry> entries_;
  std::size_t next_ = 0;
};

}  // namespace posefusion
