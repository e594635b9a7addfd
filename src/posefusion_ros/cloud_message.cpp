#include <sensor_msgs/PointField.h>

#include <array>
#include <boost/make_shared.hpp>
#include <cstring>

#include "posefusion_ros/conversions.h"

namespace posefusion {
namespace {

constexpr std::array<const char*, 9> kFields = {
    "x", "y", "z", "rgb", "normal_x", "normal_y", "normal_z", "radius", "confidence"};
constexpr std::uint32_t kPointBytes = sizeof(float) * kFields.size();

/// Colour packed as PCL and rviz expect it: the bytes of 0x00RRGGBB as a float.
float PackedRgb(const std::array<std::uint8_t, 3>& rgb) {
  const std::uint32_t bits = (static_cast<std::uint32_t>(rgb[0]) << 16U) |
                             (static_cast<std::uint32_t>(rgb[1]) << 8U) | rgb[2];
  float packed = 0;
  std::memcpy(&packed, &bits, sizeof packed);
  return packed;
}

void AddFields(sensor_msgs::PointCloud2& message) {
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    sensor_msgs::PointField field;
    field.name = kFields[i];
    field.offset = static_cast<std::uint32_t>(i * sizeof(float));
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    message.fields.push_back(field);
  }
}

}  // namespace

sensor_msgs::PointCloud2Ptr ToPointCloud2(const SurfelCloud& cloud,
                                          const std_msgs::Header& header) {
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header = header;
  message->height = 1;
  message->width = static_cast<std::uint32_t>(cloud.size());
  message->point_step = kPointBytes;
  message->row_step = kPointBytes * message->width;
  message->is_bigendian = 0U;
  message->is_dense = 1U;
  AddFields(*message);
  message->data.resize(static_cast<std::size_t>(kPointBytes) * cloud.size());
  std::uint8_t* out = message->data.data();
  for (std::size_t i = 0; i < cloud.size(); ++i, out += kPointBytes) {
    const Eigen::Vector3f& p = cloud.position_m[i];
    const Eigen::Vector3f& n = cloud.normal[i];
    const std::array<float, kFields.size()> point = {p.x(),
                                                     p.y(),
                                                     p.z(),
                                                     PackedRgb(cloud.rgb[i]),
                                                     n.x(),
                                                     n.y(),
                                                     n.z(),
                                                     cloud.radius_m[i],
                                                     cloud.confidence[i]};
    std::memcpy(out, point.data(), kPointBytes);
  }
  return message;
}

}  // namespace posefusion
