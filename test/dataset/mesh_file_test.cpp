#include "posefusion/dataset/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr char kSquare[] =
    "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty double x\n"
    "property uchar red\nproperty float y\nproperty float z\nelement face 1\n"
    "property uchar flags\nproperty list uchar uint vertex_index\nelement edge 1\n"
    "property int a\nend_header\n"
    "0 255 0 2\n1 0 0 2\n1 0 1 2\n0 0 1 2\n7 4 0 1 2 3\n5\n";

class MeshFileTest : public testing::Test {
 protected:
  TriangleMesh Read(const std::string& text) const {
    WriteFileAtomically(path_, text);
    return ReadMesh(path_);
  }

  void ExpectError(const std::string& text, const std::string& message) const {
    EXPECT_THAT([&] { Read(text); },
                ThrowsMessage<std::runtime_error>(HasSubstr(path_ + ": " + message)));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "mesh.ply";
};

TEST_F(MeshFileTest, RoundTripIsExact) {
  TriangleMesh mesh;
  mesh.vertices = {{0.1F, 2, 3}, {4, -5.7F, 6}, {7, 8, 9}, {-1, 0, 1e-9F}};
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  WriteMesh(mesh, path_);
  const TriangleMesh read = ReadMesh(path_);
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

TEST_F(MeshFileTest, PolygonsOfOtherProgramsBecomeFans) {
  const TriangleMesh mesh = Read(kSquare);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(1, 1, 2));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangles[0], Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], Eigen::Vector3i(0, 2, 3));
}

TEST_F(MeshFileTest, RefusesWhatIsNoMesh) {
  const std::string square = kSquare;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = square;
    return text.replace(text.find(from), from.size(), to);
  };
  ExpectError("", "is no complete PLY file");
  ExpectError("hello\n", "is no PLY file");
  ExpectError(with("ascii", "binary_big_endian"), "PLY is binary_big_endian");
  ExpectError(with("double", "quaternion"), "PLY property of unknown type 'quaternion'");
  ExpectError(with("vertex 4", "vertex many"), "PLY count 'many' is no number");
  ExpectError(with("0 255 0 2", "0 255 nan 2"), "PLY vertex without a finite");
  ExpectError(with("0 1 2 3", "0 1 2 4"), "PLY face with a corner that is no vertex");
  ExpectError(with("face 1", "mane 1"), "PLY has no faces");
  ExpectError(square.substr(0, square.size() - 5), "PLY is truncated");
}

TEST_F(MeshFileTest, RefusesTruncatedBytes) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  WriteMesh(mesh, path_);
  const std::string bytes = ReadWholeFile(path_);
  ExpectError(bytes.substr(0, bytes.size() - 1), "PLY is truncated");
}

}  // namespace
}  // namespace posefusion
