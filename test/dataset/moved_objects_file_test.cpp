#include "posefusion/dataset/moved_objects_file.h"

#include <gmock/gmock.h>

#include <fstream>

#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TriangleMesh TriangleAt(float z) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, z}, {1, 0, z}, {0, 1, z}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(MovedObjectsFile, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  WriteMovedObjects(
      {{"chair", 1'500'000'000, 4'250'000'000, {0.5, -1, 0}, TriangleAt(1), TriangleAt(2)},
       {"box", 7'000'000'000, 7'200'000'000, {0, 0, 1}, TriangleAt(3), TriangleAt(4)}},
      folder.path());
  const auto objects = ReadMovedObjects(folder / "moved_objects.txt");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].name, "chair");
  EXPECT_EQ(objects[0].begin_ns, 1'500'000'000);
  EXPECT_EQ(objects[0].end_ns, 4'250'000'000);
  EXPECT_EQ(objects[0].offset_m, Eigen::Vector3d(0.5, -1, 0));
  EXPECT_EQ(objects[1].before.vertices, TriangleAt(3).vertices);
  EXPECT_EQ(objects[1].after.vertices, TriangleAt(4).vertices);
}

TEST(MovedObjectsFile, LinesMayLackMeshes) {
  const TemporaryFolder folder;
  std::ofstream(folder / "moved_objects.txt") << "# comment\n1.5 4.25 chair 0.5 -1 0\n";
  const auto objects = ReadMovedObjects(folder / "moved_objects.txt");
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_TRUE(objects[0].before.triangles.empty());
}

TEST(MovedObjectsFile, NamesTheLineThatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string path = folder / "moved_objects.txt";
  const auto read = [&] { ReadMovedObjects(path); };
  for (const char* line :
       {"1 2 chair 0 0", "2 1 chair 0 0 0", "1 2 chair 0 0 x", "1 2 a 0 0 0 b"}) {
    std::ofstream(path) << line << "\n";
    EXPECT_THAT(read, ThrowsMessage<std::runtime_error>(HasSubstr("moved_objects.txt:1"))) << line;
  }
  std::ofstream(path) << "1 2 chair 0 0 0 no.ply no.ply\n";
  EXPECT_THAT(read, ThrowsMessage<std::runtime_error>(HasSubstr("no.ply")));
}

}  // namespace
}  // namespace posefusion
