#include "posefusion/common/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

bool Never() { return false; }

TEST(ChildProcess, TellsTheExitCodeAndLogsWhatIsSaid) {
  const TemporaryFolder folder;
  const std::string log = folder / "log.txt";
  const ChildExit good = RunChild({"/bin/echo", "a b", "$HOME"}, log, Never);
  EXPECT_TRUE(good.IsSuccess());
  const ChildExit bad = RunChild({"/bin/sh", "-c", "echo oh >&2; exit 3"}, log, Never);
  EXPECT_FALSE(bad.IsSuccess());
  EXPECT_EQ(bad.code, 3);
  EXPECT_EQ(ReadWholeFile(log), "a b $HOME\noh\n");
}

TEST(ChildProcess, TellsTheSignalThatEndedIt) {
  const TemporaryFolder folder;
  const ChildExit exit = RunChild({"/bin/sh", "-c", "kill -SEGV $$"}, folder / "log.txt", Never);
  EXPECT_EQ(exit.signal, SIGSEGV);
  EXPECT_FALSE(exit.IsSuccess());
  EXPECT_FALSE(exit.stopped);
}

TEST(ChildProcess, EndsWhenAskedToAndIsKilledWhenItDoesNot) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const auto always = [] { return true; };
  const ChildExit asked = RunChild({"/bin/sleep", "30"}, folder / "log.txt", always);
  EXPECT_TRUE(asked.stopped);
  EXPECT_EQ(asked.signal, SIGTERM);
  const auto ignores = [&] {
    return std::chrono::steady_clock::now() - start >= std::chrono::milliseconds(500);
  };
  const ChildExit killed = RunChild({"/bin/sh", "-c", "trap '' TERM; while :; do sleep 0.1; done"},
                                    folder / "log.txt", ignores, 0.2);
  EXPECT_TRUE(killed.stopped);
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ChildProcess, NamesWhatCannotBeRun) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { RunChild({"/nowhere/program"}, folder / "log.txt", Never); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/program: cannot be run")));
}

}  // namespace
}  // namespace posefusion
