#include "posefusion/common/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AtomicFile, ReplacesTheContentsAndLeavesNoTemporaryFile) {
  const std::string path = testing::TempDir() + "atomic_file_test.bin";
  WriteFileAtomically(path, "old and longer");
  WriteFileAtomically(path, std::string("a\0b\n", 4));
  EXPECT_EQ(ReadWholeFile(path), std::string("a\0b\n", 4));
  EXPECT_FALSE(std::filesystem::exists(path + ".tmp"));
}

TEST(AtomicFile, ReadsFilesLargerThanOneBlock) {
  const std::string path = testing::TempDir() + "atomic_file_test_large.bin";
  const std::string contents(1'000'003, 'x');
  WriteFileAtomically(path, contents);
  EXPECT_EQ(ReadWholeFile(path), contents);
}

TEST(AtomicFile, NamesTheFileThatCannotBeWrittenOrRead) {
  EXPECT_THAT([] { WriteFileAtomically("/nowhere/file.txt", ""); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/file.txt: cannot be written")));
  EXPECT_THAT([] { ReadWholeFile("/nowhere/file.txt"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/file.txt: cannot be read")));
}

}  // namespace
}  // namespace posefusion
