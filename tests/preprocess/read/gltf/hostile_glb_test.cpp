// Binary files whose container lies, is cut, or is changed at random.
#include <random>

#include "tests/preprocess/read/gltf/hostile_files.h"

namespace farcell::test {
namespace {

void expectError(const Result<ReadMesh>& result) {
  ASSERT_FALSE(result);
  for (const char* part : {"model.glb", "expected", "found"})
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
}

std::string withWord(std::string bytes, size_t offset, uint32_t value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(value));
  return bytes;
}

TEST(HostileGlb, IsAnErrorAtEveryTruncation) {
  const TempDirectory directory;
  const std::string whole = everything().glb();
  for (size_t length = 0; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    expectError(readMesh(directory.write("model.glb", whole.substr(0, length))));
  }
}

TEST(HostileGlb, IsAnErrorAtEveryTruncationWhoseLengthsAreMadeToFit) {
  const TempDirectory directory;
  const std::string whole = everything().glb();
  const size_t jsonBytes = everything().root.dump().size();
  const size_t end = 20 + (jsonBytes + 3) / 4 * 4 + 8 + everything().binary().size();  // without padding
  for (size_t length = 20; length < end; ++length) {
    SCOPED_TRACE(length);
    std::string cut = withWord(whole.substr(0, length), 8, uint32_t(length));
    if (length < 20 + jsonBytes) cut = withWord(cut, 12, uint32_t(length - 20));
    const size_t binary = 20 + (jsonBytes + 3) / 4 * 4;
    if (length >= binary + 8) cut = withWord(cut, binary, uint32_t(length - binary - 8));
    expectError(readMesh(directory.write("model.glb", cut)));
  }
}

TEST(HostileGlb, HeadersAndChunksThatLieAreRefused) {
  const TempDirectory directory;
  const std::string whole = everything().glb();
  const auto fails = [&](const std::string& bytes) { expectError(readMesh(directory.write("model.glb", bytes))); };
  const auto jsonLength = uint32_t((everything().root.dump().size() + 3) / 4 * 4);
  const size_t binary = 20 + jsonLength;
  fails(withWord(whole, 0, 0x46546C68));  // the magic
  for (const uint32_t version : {0u, 1u, 3u, UINT32_MAX}) fails(withWord(whole, 4, version));
  for (const uint32_t length : {0u, 12u, uint32_t(whole.size() - 1), uint32_t(whole.size() + 1), UINT32_MAX})
    fails(withWord(whole, 8, length));
  for (const uint32_t length : {0u, 4u, jsonLength - 4, jsonLength + 4, uint32_t(whole.size()), UINT32_MAX})
    fails(withWord(whole, 12, length));
  fails(withWord(whole, 16, 0x004E4942));  // the first chunk a binary one
  fails(withWord(whole, 16, 0));
  for (const uint32_t length :
       {0u, 4u, uint32_t(whole.size() - binary - 12), uint32_t(whole.size() - binary - 4), UINT32_MAX})
    fails(withWord(whole, binary, length));
  fails(withWord(whole, binary + 4, 0x4E4F534A));  // a second chunk of JSON
  fails(withWord(whole, binary + 4, 0));
  fails(withWord(whole + "x", 8, uint32_t(whole.size() + 1)));  // a byte that is no chunk
  fails(whole + std::string(8, '\0'));
  fails(GltfWriter::glbOf("", everything().binary()));
  fails(GltfWriter::glbOf(everything().root.dump(), ""));
  fails(GltfWriter::glbOf("[]", everything().binary()));
  fails(GltfWriter::glbOf(everything().root.dump(), everything().binary().substr(4)));
}

TEST(HostileGlb, ChunksOfOtherTypesMayFollow) {
  const TempDirectory directory;
  std::string bytes = everything().glb() + std::string("\4\0\0\0XYZ1abcd", 12);
  bytes = withWord(bytes, 8, uint32_t(bytes.size()));
  EXPECT_EQ(readGood(directory.write("model.glb", bytes)).info.declaredTriangles, 6u);
}

TEST(HostileGlb, SurvivesAnyChangedBytes) {
  const TempDirectory directory;
  constexpr uint32_t kSeed = 20240611;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  const std::string whole = everything().glb();
  int readable = 0;
  for (int round = 0; round < fuzzRounds(); ++round) {
    std::string bytes = whole;
    for (uint32_t i = 0; i <= random() % 4; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    readable += readMesh(directory.write("model.glb", bytes)).has_value();  // checks the counts where it is one
  }
  EXPECT_GT(readable, 0);
}

// A value of the tree, any with the same chance, and what it might be instead.
json* anyValue(json& root, std::mt19937& random) {
  std::vector<json*> all;
  std::vector<json*> open = {&root};
  while (!open.empty()) {
    json* value = open.back();
    open.pop_back();
    all.push_back(value);
    for (json& child : *value)
      if (value->is_structured()) open.push_back(&child);
  }
  return all[random() % all.size()];
}

json anyReplacement(const json& old, std::mt19937& random) {
  switch (random() % 10) {
    case 0:
      return nullptr;
    case 1:
      return json::array();
    case 2:
      return json::object();
    case 3:
      return "x";
    case 4:
      return -1;
    case 5:
      return uint64_t{1} << random() % 64;
    case 6:
      return 1e300;
    case 7:
      return old.is_number() ? json(old.get<double>() + 1) : json(0);
    case 8:
      return json::array({old, old});
    default:
      return random() % 12;
  }
}

TEST(HostileGlb, SurvivesAnyChangedJson) {
  const TempDirectory directory;
  constexpr uint32_t kSeed = 20240612;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  const GltfWriter good = everything();
  int readable = 0;
  for (int round = 0; round < 2 * fuzzRounds(); ++round) {
    GltfWriter writer = good;
    for (uint32_t i = 0; i <= random() % 2; ++i) {
      json* value = anyValue(writer.root, random);
      *value = anyReplacement(*value, random);
    }
    const auto result = readMesh(directory.write("model.glb", GltfWriter::glbOf(writer.root.dump(), writer.binary())));
    readable += result.has_value();
    const std::string message = result ? "expected" : result.error().message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
  }
  EXPECT_GT(readable, fuzzRounds() / 20);
}

}  // namespace
}  // namespace farcell::test
