#include "preprocess/read/open_mesh.h"

#include <sys/stat.h>

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

constexpr const char* kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* kStl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

std::string formatOf(const std::filesystem::path& path) {
  const auto mesh = openMesh(path);
  return mesh ? (*mesh)->info().format : mesh.error().message;
}

TEST(OpenMesh, RefusesWhatIsNoRegularFile) {
  const TempDirectory directory;
  EXPECT_FALSE(openMesh(directory.path()));
  for (const char* name : {"pipe.ply", "pipe.json"}) {
    const auto fifo = directory.path() / name;
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    EXPECT_FALSE(openMesh(fifo));
  }
  for (const char* name : {"missing.ply", "missing.json"}) {
    const auto missing = openMesh(directory.path() / name);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
  }
}

TEST(OpenMesh, NamesTheFormatsThatItReadsWhereItCannot) {
  const TempDirectory directory;
  const auto result = openMesh(directory.write("a.xyz", "solid nothing"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::unsupported);
  for (const char* name : {".xyz", ".ply", ".obj", ".stl", ".off", ".gltf", ".glb"})
    EXPECT_NE(result.error().message.find(name), std::string::npos) << result.error().message;
}

TEST(OpenMesh, RefusesEmptyFilesOfEveryFormat) {
  const TempDirectory directory;
  for (const char* name : {"empty.ply", "empty.obj", "empty.stl", "empty.off", "empty.json"}) {
    const auto result = openMesh(directory.write(name, ""));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::corrupt) << result.error().message;
  }
}

TEST(OpenMesh, GoesByTheContentWhereItIsCertainAndElseByTheNameInEitherCase) {
  const TempDirectory directory;
  EXPECT_EQ(formatOf(directory.write("mesh", kOff)), "OFF");
  EXPECT_EQ(formatOf(directory.write("mesh.obj", kOff)), "OFF");
  std::string binary(84 + 50, '\0');
  binary[80] = 1;
  EXPECT_EQ(formatOf(directory.write("mesh.obj", binary)), "STL, binary");
  EXPECT_EQ(formatOf(directory.write("mesh.STL", kStl)), "STL, ASCII");
  EXPECT_EQ(formatOf(directory.write("mesh.Obj", "v 0 0 0\n")), "OBJ");
  // Nothing but a name tells an OBJ from another text.
  EXPECT_NE(formatOf(directory.write("mesh.obj", kStl)).find("expected 'v' and 'f' statements"), std::string::npos);
}

}  // namespace
}  // namespace farcell::test
