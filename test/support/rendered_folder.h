#pragma once

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "posefusion/common/stamp.h"
#include "test/support/rendered_source.h"

namespace posefusion::testing {

/// Writes rendered frames as a folder in TUM format.
inline void WriteRenderedFolder(const std::string& folder, int num_frames) {
  constexpr double kDepthScale = 5000;
  std::filesystem::create_directories(folder + "/rgb");
  std::filesystem::create_directories(folder + "/depth");
  std::ofstream rgb_list(folder + "/rgb.txt");
  std::ofstream depth_list(folder + "/depth.txt");
  RenderedSource source(num_frames);
  while (const auto frame = source.Next()) {
    const std::string stamp = FormatStamp(frame->stamp_ns);
    cv::Mat bgr;
    cv::cvtColor(frame->rgb, bgr, cv::COLOR_RGB2BGR);
    cv::imwrite(folder + "/rgb/" + stamp + ".png", bgr);
    cv::Mat depth;
    frame->depth_m.convertTo(depth, CV_16UC1, kDepthScale);
    cv::imwrite(folder + "/depth/" + stamp + ".png", depth);
    rgb_list << stamp << " rgb/" << stamp << ".png\n";
    depth_list << stamp << " depth/" << stamp << ".png\n";
  }
  const CameraModel camera = SmallCamera();
  std::ofstream(folder + "/camera.yaml")
      << "width: " << camera.width << "\nheight: " << camera.height << "\nfx: " << camera.fx
      << "\nfy: " << camera.fy << "\ncx: " << camera.cx << "\ncy: " << camera.cy
      << "\ndistortion: [0, 0, 0, 0, 0]\ndepth_scale: " << kDepthScale << "\n";
}

}  // namespace posefusion::testing
