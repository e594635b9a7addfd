#pragma once

#include <nodelet/nodelet.h>

#include <exception>

namespace posefusion {

/// A nodelet whose start may throw. The manager swallows the texts of exceptions, so they are
/// logged as FATAL before they go on.
class CheckedNodelet : public nodelet::Nodelet {
 private:
  void onInit() final {
    try {
      Start();
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  /// Reads parameters, advertises and subscribes. Called once.
  virtual void Start() = 0;
};

}  // namespace posefusion
