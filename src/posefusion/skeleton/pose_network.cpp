#include "posefusion/skeleton/pose_network.h"

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "posefusion/skeleton/part_grouping.h"
#include "posefusion/skeleton/pose_network_file.h"

namespace posefusion {
namespace {

constexpr int kNumOutputs = 57;     ///< 18 joints, background, 38 affinity fields
constexpr int kFirstAffinity = 19;  ///< behind the background's heat map
constexpr int kStride = 8;          ///< input pixels per pixel of the maps

std::string ShapeText(const cv::Mat& blob) {
  std::string text;
  for (int i = 0; i < blob.dims; ++i) text += (i > 0 ? " x " : "") + std::to_string(blob.size[i]);
  return text;
}

/// A place in the maps in pixels of an image of that size; the last cell may reach beyond it.
float ToImage(float map_pixel, float scale, int image_size) {
  const float pixel = (map_pixel + 0.5F) * static_cast<float>(kStride) / scale - 0.5F;
  return std::clamp(pixel, 0.0F, static_cast<float>(image_size - 1));
}

}  // namespace

class PoseNetwork::Engine {
 public:
  explicit Engine(const PoseNetworkConfig& config)
      : config_(CheckedConfig(config)),
        input_size_(config_.input_width_px, config_.input_height_px),
        preparation_(PreparationOf(config_)),
        net_(LoadPoseNetwork(config_)),
        input_(input_size_, CV_8UC3) {
    cv::setNumThreads(config_.num_threads);
    RunOnce();
  }

  std::vector<Skeleton> Detect(const cv::Mat& rgb) {
    if (rgb.empty() || rgb.type() != CV_8UC3) {
      throw std::invalid_argument("pose network: image of type " + cv::typeToString(rgb.type()) +
                                  (rgb.empty() ? " is empty" : "") + ", expected 8UC3");
    }
    try {
      const float scale = FillInput(rgb);
      Forward();
      return InImagePixels(GroupParts(Maps(rgb.size(), scale), config_.grouping), rgb.size(),
                           scale);
    } catch (const cv::Exception& error) {
      throw std::runtime_error("pose network " + config_.model + ": " + error.err);
    }
  }

  const PoseNetworkConfig& config() const { return config_; }

 private:
  /// Shows what the network makes of a grey image.
  void RunOnce() {
    input_.setTo(cv::Scalar::all(128));
    try {
      Forward();
    } catch (const cv::Exception& error) {
      throw std::invalid_argument("pose_network.model: " + config_.model + " does not take " +
                                  "input_width_px x input_height_px = " + SizeText() + ": " +
                                  error.err);
    }
    CheckOutput();
  }

  void CheckOutput() const {
    const bool is_pose_map = output_.dims == 4 && output_.type() == CV_32F && output_.size[0] == 1;
    if (!is_pose_map || output_.size[1] != kNumOutputs) {
      throw std::invalid_argument(
          "pose_network.model: " + config_.model + " gives " + ShapeText(output_) +
          " values; a COCO pose network gives 1 x 57 x height / 8 x width / 8");
    }
    if (output_.size[2] * kStride != input_size_.height ||
        output_.size[3] * kStride != input_size_.width) {
      throw std::invalid_argument(
          "pose_network.model: " + config_.model + " gives maps of " + ShapeText(output_) +
          " for input_width_px x input_height_px = " + SizeText() + "; expected an eighth of it");
    }
  }

  std::string SizeText() const {
    return std::to_string(input_size_.width) + " x " + std::to_string(input_size_.height);
  }

  /// Brings the image to the network's size, as much of it as its shape allows; the rest is what
  /// the network takes for zero. Returns input pixels per image pixel.
  float FillInput(const cv::Mat& rgb) {
    const double scale = std::min(static_cast<double>(input_size_.width) / rgb.cols,
                                  static_cast<double>(input_size_.height) / rgb.rows);
    const cv::Size size(std::max(1, cvRound(scale * rgb.cols)),
                        std::max(1, cvRound(scale * rgb.rows)));
    input_.setTo(preparation_.mean);
    cv::Mat inside = input_(cv::Rect({}, size));
    cv::resize(rgb, inside, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    return static_cast<float>(scale);
  }

  void Forward() {
    cv::dnn::blobFromImage(input_, blob_, preparation_.scale, cv::Size(), preparation_.mean,
                           preparation_.takes_bgr, false, CV_32F);
    net_.setInput(blob_);
    output_ = net_.forward();
  }

  /// The network's output as images that share its memory, as far as they show the image.
  PartMaps Maps(const cv::Size& image_size, float scale) {
    const auto covered = [scale](int image_pixels, int map_pixels) {
      const double pixels = std::ceil(scale * static_cast<float>(image_pixels) / kStride);
      return std::clamp(static_cast<int>(pixels), 1, map_pixels);
    };
    const cv::Rect shown(0, 0, covered(image_size.width, output_.size[3]),
                         covered(image_size.height, output_.size[2]));
    const auto map = [&](int channel) {
      return cv::Mat(output_.size[2], output_.size[3], CV_32F,
                     output_.ptr<float>(0, channel))(shown);
    };
    PartMaps maps;
    for (int i = 0; i < kNumCocoJoints; ++i) maps.heat[static_cast<std::size_t>(i)] = map(i);
    for (int i = 0; i < kNumAffinityFields; ++i) {
      maps.affinity[static_cast<std::size_t>(i)] = map(kFirstAffinity + i);
    }
    return maps;
  }

  static std::vector<Skeleton> InImagePixels(std::vector<Skeleton> people, const cv::Size& size,
                                             float scale) {
    for (Skeleton& person : people) {
      for (Joint& joint : person) {
        if (joint.p <= 0) continue;
        joint.u = ToImage(joint.u, scale, size.width);
        joint.v = ToImage(joint.v, scale, size.height);
      }
    }
    return people;
  }

  const PoseNetworkConfig config_;
  const cv::Size input_size_;
  const ImagePreparation preparation_;
  cv::dnn::Net net_;
  cv::Mat input_;
  cv::Mat blob_;
  cv::Mat output_;
};

PoseNetwork::PoseNetwork(const PoseNetworkConfig& config)
    : engine_(std::make_unique<Engine>(config)) {}
PoseNetwork::~PoseNetwork() = default;
PoseNetwork::PoseNetwork(PoseNetwork&&) noexcept = default;
PoseNetwork& PoseNetwork::operator=(PoseNetwork&&) noexcept = default;

std::vector<Skeleton> PoseNetwork::Detect(const cv::Mat& rgb) { return engine_->Detect(rgb); }

const PoseNetworkConfig& PoseNetwork::config() const { return engine_->config(); }

}  // namespace posefusion
