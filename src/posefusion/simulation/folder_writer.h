#pragma once

#include <memory>
#include <string>

#include "posefusion/common/task_thread.h"
#include "posefusion/simulation/simulator.h"
#include "posefusion/simulation/truth_recorder.h"

namespace posefusion {

/// Writes a simulated run as a folder in the format of the TUM RGB-D benchmark (rgb/, depth/ in
/// units of 1/5000 m) with labels/ and keypoints/ by colour stamp and the files of TruthRecorder.
///
/// Everything grows in `<folder>.partial` and gets its name in Close; without Close nothing stays.
class FolderWriter {
 public:
  /// An existing folder must be empty, or with `force` hold a simulated run, which Close replaces.
  /// @throws std::runtime_error naming the folder and what is wrong with it.
  FolderWriter(const std::string& folder, bool force);
  ~FolderWriter();
  FolderWriter(const FolderWriter&) = delete;
  FolderWriter& operator=(const FolderWriter&) = delete;

  /// Frames come in their order, and their images must stay as they are: a thread of its own writes
  /// them. @throws std::runtime_error naming a file, of this or an earlier frame, that cannot be
  /// written.
  void Write(const SimulatedFrame& frame, const Simulator& simulator);

  /// Writes the lists and the truth and gives the folder its name. @throws as Write.
  void Close(const Simulator& simulator);

 private:
  std::string PathOf(const std::string& name) const { return partial_ + "/" + name; }
  void WriteImages(const SimulatedFrame& frame) const;
  void WriteKeypoints(const SimulatedFrame& frame, const Simulator& simulator);

  std::string folder_;
  std::string partial_;
  bool complete_ = false;
  std::string arrivals_ = "# stamp arrival_stamp\n";
  TruthRecorder truth_;
  std::unique_ptr<TaskThread> images_;
};

}  // namespace posefusion
