#include "posefusion/common/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace posefusion {
namespace {

constexpr std::size_t kReadBlockBytes = 1 << 18;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

[[noreturn]] void ThrowFor(const std::string& path, const char* what, int error) {
  throw std::runtime_error(path + ": " + what + ": " + std::strerror(error));
}

/// Zero, or the errno of the first step that failed.
int WriteContents(const std::string& path, const std::string& contents) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) return errno;
  if (std::fwrite(contents.data(), 1, contents.size(), file.get()) != contents.size()) return errno;
  return std::fclose(file.release()) == 0 ? 0 : errno;
}

}  // namespace

void WriteFileAtomically(const std::string& path, const std::string& contents) {
  const std::string temporary = path + ".tmp";
  int error = WriteContents(temporary, contents);
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  std::remove(temporary.c_str());
  ThrowFor(path, "cannot be written", error);
}

std::string ReadWholeFile(const std::string& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) ThrowFor(path, "cannot be read", errno);
  std::string contents;
  std::size_t num_read = 0;
  do {
    const std::size_t size = contents.size();
    contents.resize(size + kReadBlockBytes);
    num_read = std::fread(contents.data() + size, 1, kReadBlockBytes, file.get());
    contents.resize(size + num_read);
  } while (num_read == kReadBlockBytes);
  if (std::ferror(file.get()) != 0) ThrowFor(path, "cannot be read", errno);
  return contents;
}

}  // namespace posefusion
