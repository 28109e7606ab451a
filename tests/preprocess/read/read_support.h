// Small mesh files written by tests, and what a reader makes of them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "preprocess/read/open_mesh.h"

namespace farcell::test {

// A directory of its own for one test, removed with it.
class TempDirectory {
 public:
  TempDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "farcell-read.XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  TempDirectory(const TempDirectory&) = delete;
  TempDirectory& operator=(const TempDirectory&) = delete;
  ~TempDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    // Not truncated in place: some file systems write such files out at once, which makes thousands of them slow.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

struct ReadMesh {
  MeshInfo info;
  MeshCounts counts;
  std::vector<InputTriangle> triangles;

  uint64_t skipped() const {
    uint64_t sum = 0;
    for (const auto& [reason, count] : counts.skipped) sum += count;
    return sum;
  }
};

inline Result<std::vector<InputTriangle>> collect(MeshReader& reader, MeshCounts& counts) {
  std::vector<InputTriangle> triangles;
  auto pass = reader.forEachTriangle([&](std::span<const InputTriangle> batch) -> Result<> {
    EXPECT_LE(batch.size(), 65536u);
    EXPECT_FALSE(batch.empty());
    triangles.insert(triangles.end(), batch.begin(), batch.end());
    return {};
  });
  if (!pass) return tl::unexpected<Error>(pass.error());
  counts = *pass;
  return triangles;
}

inline Result<ReadMesh> readMesh(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> reader, openMesh(path));
  ReadMesh mesh;
  mesh.info = reader->info();
  FARCELL_ASSIGN(mesh.triangles, collect(*reader, mesh.counts));
  EXPECT_EQ(mesh.counts.accepted, mesh.triangles.size());
  EXPECT_EQ(mesh.counts.accepted + mesh.skipped(), mesh.info.declaredTriangles);
  return mesh;
}

// For files that must be right.
inline ReadMesh readGood(const std::filesystem::path& path) {
  Result<ReadMesh> mesh = readMesh(path);
  if (mesh) return std::move(*mesh);
  ADD_FAILURE() << mesh.error().message;
  return {};
}

// A file that must be refused, and what the message says about it.
struct BadFile {
  std::string bytes;
  std::string says;
  ErrorKind kind = ErrorKind::corrupt;
};

// Messages name the path, and what was expected and found.
inline void expectRefused(const TempDirectory& directory, const std::string& name, const BadFile& bad) {
  SCOPED_TRACE(bad.bytes.substr(0, 200));
  const std::filesystem::path path = directory.write(name, bad.bytes);
  const Result<ReadMesh> result = readMesh(path);
  ASSERT_FALSE(result);
  const std::string& message = result.error().message;
  EXPECT_EQ(result.error().kind, bad.kind) << message;
  EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
  EXPECT_NE(message.find("expected "), std::string::npos) << message;
  EXPECT_NE(message.find("found "), std::string::npos) << message;
  EXPECT_NE(message.find(bad.says), std::string::npos) << message << "\nshould say: " << bad.says;
  EXPECT_LT(message.size(), 1000u);
}

// A PLY body, value by value, in one of the three encodings.
enum class Encoding { ascii, little, big };

inline const char* formatName(Encoding encoding) {
  return encoding == Encoding::ascii    ? "ascii"
         : encoding == Encoding::little ? "binary_little_endian"
                                        : "binary_big_endian";
}

class PlyBody {
 public:
  explicit PlyBody(Encoding encoding) : encoding_(encoding) {}

  template <class T>
  PlyBody& put(T value) {
    if (encoding_ == Encoding::ascii) {
      bytes_ += fmt::format("{}", +value) + " ";
    } else {
      std::string raw(sizeof(T), '\0');
      std::memcpy(raw.data(), &value, sizeof(T));
      if (encoding_ == Encoding::big) std::reverse(raw.begin(), raw.end());
      bytes_ += raw;
    }
    return *this;
  }
  template <class T, class... Rest>
  PlyBody& put(T first, Rest... rest) {
    put(first);
    return put(rest...);
  }
  PlyBody& endRow() {
    if (encoding_ == Encoding::ascii) bytes_ += "\n";
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Encoding encoding_;
  std::string bytes_;
};

inline std::string plyHeader(Encoding encoding, const std::string& elements) {
  return fmt::format("ply\nformat {} 1.0\n{}end_header\n", formatName(encoding), elements);
}

inline bool samePositions(const InputTriangle& a, const InputTriangle& b) { return a.positions == b.positions; }

}  // namespace farcell::test
