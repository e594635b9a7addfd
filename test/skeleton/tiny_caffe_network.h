#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "posefusion/common/atomic_file.h"

namespace posefusion::testing {

/// One value per output channel: bias + weights * (blue, green, red), means over 8 x 8 pixels.
struct ChannelWeights {
  float first = 0;  ///< of the network's first input channel, which is blue for OpenPose
  float second = 0;
  float third = 0;
  float bias = 0;
};

/// A caffe network of one layer with weights to choose, for 64 x 64 pixels, as the two files that
/// caffe has.
class TinyCaffeNetwork {
 public:
  explicit TinyCaffeNetwork(std::size_t num_channels) : channels(num_channels) {}

  void Write(const std::string& prototxt, const std::string& caffemodel) const {
    WriteFileAtomically(prototxt, Description());
    WriteFileAtomically(caffemodel, Weights());
  }

  std::vector<ChannelWeights> channels;

 private:
  std::string Description() const {
    return "input: \"image\"\ninput_shape { dim: 1 dim: 3 dim: 64 dim: 64 }\n"
           "layer { name: \"cells\" type: \"Pooling\" bottom: \"image\" top: \"cells\"\n"
           "  pooling_param { pool: AVE kernel_size: 8 stride: 8 } }\n"
           "layer { name: \"maps\" type: \"Convolution\" bottom: \"cells\" top: \"maps\"\n"
           "  convolution_param { num_output: " +
           std::to_string(channels.size()) + " kernel_size: 1 } }\n";
  }

  // Protocol buffers' wire format; the field numbers are those of caffe.proto.

  static std::string Number(std::uint64_t value) {
    std::string bytes;
    for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(0x80 | (value & 0x7f));
    return bytes + static_cast<char>(value);
  }

  static std::string Field(std::uint64_t number, const std::string& contents) {
    constexpr std::uint64_t kLengthDelimited = 2;
    return Number(number << 3 | kLengthDelimited) + Number(contents.size()) + contents;
  }

  static std::string Blob(const std::vector<std::uint64_t>& shape,
                          const std::vector<float>& values) {
    std::string dimensions;
    for (const std::uint64_t size : shape) dimensions += Number(size);
    std::string data(values.size() * sizeof(float), '\0');
    std::memcpy(data.data(), values.data(), data.size());
    return Field(5, data) + Field(7, Field(1, dimensions));
  }

  std::string Weights() const {
    std::vector<float> weights;
    std::vector<float> biases;
    for (const ChannelWeights& channel : channels) {
      weights.insert(weights.end(), {channel.first, channel.second, channel.third});
      biases.push_back(channel.bias);
    }
    const std::uint64_t count = channels.size();
    return Field(100, Field(1, "maps") + Field(2, "Convolution") +
                          Field(7, Blob({count, 3, 1, 1}, weights)) +
                          Field(7, Blob({count}, biases)));
  }
};

}  // namespace posefusion::testing
