#include "posefusion/common/confined_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A folder `out` with a file and a folder in it, beside a folder that is nobody's business.
class ConfinedPathTest : public testing::Test {
 protected:
  ConfinedPathTest() {
    fs::create_directories(folder_ / "out/below");
    fs::create_directories(folder_ / "other");
    WriteFileAtomically(folder_ / "out/there.ply", "old");
  }

  std::string out() const { return folder_ / "out"; }
  std::string Path(const std::string& name, bool overwrite = false) const {
    return ConfinedPath(out(), name, overwrite);
  }
  void ExpectRefused(const std::string& name, const std::string& why, bool overwrite = false) {
    EXPECT_THAT([&] { Path(name, overwrite); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(why)))
        << name;
  }

  TemporaryFolder folder_;
};

TEST_F(ConfinedPathTest, NamesInTheFolderAndBelowAreGiven) {
  EXPECT_EQ(Path("map.ply"), fs::canonical(out()) / "map.ply");
  EXPECT_EQ(Path("./below/map.ply"), fs::canonical(out()) / "below/map.ply");
  EXPECT_EQ(ConfinedPath(out() + "/", "map..ply", false), fs::canonical(out()) / "map..ply");
}

TEST_F(ConfinedPathTest, NamesThatLeaveTheFolderAreRefused) {
  ExpectRefused("/tmp/map.ply", "is absolute");
  ExpectRefused("../map.ply", "'..'");
  ExpectRefused("below/../../map.ply", "'..'");
  ExpectRefused("below/../map.ply", "'..'");
  ExpectRefused("", "is empty");
  ExpectRefused(".", "names a folder");
  ExpectRefused("below/", "names a folder");
  ExpectRefused(std::string("a\0b", 3), "zero byte");
}

TEST_F(ConfinedPathTest, LinksThatLeadOutAreRefusedEvenForOverwriting) {
  fs::create_symlink(folder_ / "other", folder_ / "out/link");
  fs::create_symlink(folder_ / "other/target", folder_ / "out/file_link");
  ExpectRefused("link/map.ply", "leads out", true);
  ExpectRefused("file_link", "is a link", true);
  EXPECT_FALSE(fs::exists(folder_ / "other/target"));
}

TEST_F(ConfinedPathTest, LinksThatStayInsideAreFollowed) {
  fs::create_directory_symlink(folder_ / "out/below", folder_ / "out/inner");
  EXPECT_EQ(Path("inner/map.ply"), fs::canonical(out()) / "below/map.ply");
}

TEST_F(ConfinedPathTest, FolderWhoseNameBeginsAlikeIsNotInside) {
  fs::create_directories(folder_ / "out_too");
  fs::create_symlink(folder_ / "out_too", folder_ / "out/link");
  ExpectRefused("link/map.ply", "leads out");
}

TEST_F(ConfinedPathTest, ExistingFilesAreOverwrittenOnlyWhenAskedFor) {
  ExpectRefused("there.ply", "exists");
  EXPECT_EQ(Path("there.ply", true), fs::canonical(out()) / "there.ply");
  ExpectRefused("below", "is not a file", true);
}

TEST_F(ConfinedPathTest, MissingFoldersAreNamed) {
  ExpectRefused("nowhere/map.ply", "cannot be used");
  EXPECT_THAT([&] { ConfinedPath(folder_ / "missing", "map.ply", false); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("missing")));
}

}  // namespace
}  // namespace posefusion
