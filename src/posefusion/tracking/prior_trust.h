#pragma once

namespace posefusion {

/// Whether priors deserve to be used: one that contradicts the images loses the trust in those
/// after it, until enough of them in a row have agreed.
class PriorTrust {
 public:
  explicit PriorTrust(int regain_frames) : regain_frames_(regain_frames), agreed_(regain_frames) {}

  bool trusted() const { return agreed_ >= regain_frames_; }

  /// Whether the prior of one more frame agreed with the images.
  void Note(bool agrees) {
    if (!agrees) {
      agreed_ = 0;
    } else if (agreed_ < regain_frames_) {
      ++agreed_;
    }
  }

 private:
  int regain_frames_;
  int agreed_;
};

}  // namespace posefusion
