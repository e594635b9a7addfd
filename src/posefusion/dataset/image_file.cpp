#include "posefusion/dataset/image_file.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"

namespace posefusion {
namespace {

constexpr char kPngStart[] = "\x89PNG\r\n\x1a\n";
constexpr char kPngEnd[] = "IEND\xae\x42\x60\x82";
constexpr char kJpegStart[] = "\xff\xd8\xff";
constexpr char kJpegEnd[] = "\xff\xd9";
constexpr unsigned char kJpegStartOfScan = 0xda;

bool StartsWith(const std::string& bytes, const std::string& start) {
  return bytes.compare(0, start.size(), start) == 0;
}

unsigned int ByteAt(const std::string& bytes, std::size_t position) {
  return static_cast<unsigned char>(bytes[position]);
}

/// Whether the end marker follows the first scan. The segments before it are skipped by their
/// lengths, since a preview inside them has an end marker of its own (ITU-T T.81, annex B).
bool IsWholeJpeg(const std::string& bytes) {
  std::size_t position = 2;
  while (position + 4 <= bytes.size() && ByteAt(bytes, position) == 0xff) {
    if (ByteAt(bytes, position + 1) == kJpegStartOfScan) {
      return bytes.find(kJpegEnd, position) != std::string::npos;
    }
    position += 2 + 256 * ByteAt(bytes, position + 2) + ByteAt(bytes, position + 3);
  }
  return false;
}

/// The decoders fill the missing part of a truncated image with grey and merely print a warning,
/// so the end is looked for beforehand.
void CheckWhole(const std::string& bytes, const std::string& path) {
  const bool is_png = StartsWith(bytes, kPngStart);
  if (!is_png && !StartsWith(bytes, kJpegStart)) {
    throw std::runtime_error(path + ": neither PNG nor JPEG");
  }
  const bool whole = is_png ? bytes.rfind(kPngEnd) != std::string::npos : IsWholeJpeg(bytes);
  if (!whole) throw std::runtime_error(path + ": image is truncated");
}

cv::Mat ReadImage(const std::string& path, int flags) {
  const std::string bytes = ReadWholeFile(path);
  CheckWhole(bytes, path);
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1,
                       const_cast<char*>(bytes.data()));  // read only
  cv::Mat image;
  try {
    image = cv::imdecode(buffer, flags);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(path + ": image cannot be decoded: " + error.err);
  }
  if (image.empty()) throw std::runtime_error(path + ": image cannot be decoded");
  return image;
}

}  // namespace

cv::Mat ReadColourImage(const std::string& path) {
  const cv::Mat bgr = ReadImage(path, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

cv::Mat ReadDepthImage(const std::string& path) {
  cv::Mat depth = ReadImage(path, cv::IMREAD_UNCHANGED);
  if (depth.type() == CV_16UC1) return depth;
  throw std::runtime_error(path + ": depth of type " + cv::typeToString(depth.type()) +
                           ", expected 16UC1");
}

void WriteImage(const cv::Mat& image, const std::string& path, const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  const std::string ending = std::filesystem::path(path).extension().string();
  if (!cv::imencode(ending, image, bytes, parameters)) {
    throw std::runtime_error(path + ": cannot be encoded");
  }
  WriteFileAtomically(path, std::string(bytes.begin(), bytes.end()));
}

}  // namespace posefusion
