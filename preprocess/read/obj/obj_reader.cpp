#include "preprocess/read/obj/obj_reader.h"

#include <array>
#include <unordered_set>

#include "preprocess/mesh/number_text.h"
#include "preprocess/mesh/triangle_batch.h"
#include "preprocess/read/obj/obj_face.h"
#include "preprocess/read/obj/obj_looks.h"
#include "preprocess/read/obj/obj_materials.h"
#include "preprocess/read/obj/obj_text.h"

namespace farcell {
namespace {

// Everything but the faces, and what the faces say about themselves as a whole.
struct ObjContents {
  explicit ObjContents(const std::shared_ptr<ReadMemory>& memory)
      : vertices(memory, {.isWide = true, .hasColours = true}), normals(memory), coordinates(memory) {}

  Vertices vertices;
  PagedArray<glm::vec3> normals;
  PagedArray<glm::vec2> coordinates;              // of textures
  MemoryClaim names;                              // for the next two
  std::vector<std::string> libraries;             // rests of mtllib statements
  std::unordered_set<std::string> usedMaterials;  // by at least one face
  bool hasColours = false;                        // at least one vertex
  uint64_t triangles = 0;
  bool everyCornerHasNormal = true;
  uint64_t greatestNormal = 0;
};

// The first pass.
class ObjScan {
 public:
  ObjScan(const InputFile& file, std::shared_ptr<ReadMemory> memory)
      : memory_(std::move(memory)), lines_(file), contents_(memory_) {}

  Result<ObjContents> run() {
    bool anything = false;
    for (std::string_view line; lines_.next(line);) {
      const std::string_view keyword = takeWord(line);
      anything |= keyword == "v" || keyword == "f";
      if (keyword == "v") FARCELL_TRY(addVertex(line));
      if (keyword == "vt") FARCELL_TRY(addCoordinates(line));
      if (keyword == "vn") FARCELL_TRY(addNormal(line));
      if (keyword == "f") FARCELL_TRY(countFace(line));
      if (keyword == "usemtl") {
        material_ = trimmed(line);
        materialIsUsed_ = false;
      }
      if (keyword == "mtllib") {
        FARCELL_TRY(claimName(trimmed(line)));
        contents_.libraries.emplace_back(trimmed(line));
      }
      if (keyword.find('\0') != std::string_view::npos) return lines_.bad("text", "a zero byte");
    }
    if (lines_.failure()) return tl::unexpected<Error>(*lines_.failure());
    if (!anything) return lines_.bad("'v' and 'f' statements of an OBJ file", "none up to the end of the file");
    return std::move(contents_);
  }

 private:
  Result<> addVertex(std::string_view rest);
  Result<> addCoordinates(std::string_view rest);
  Result<> addNormal(std::string_view rest);
  Result<> countFace(std::string_view rest);
  Result<> claimName(std::string_view name);

  std::shared_ptr<ReadMemory> memory_;
  ObjLines lines_;
  ObjContents contents_;
  std::string material_;
  bool materialIsUsed_ = false;  // noted already
};

Result<> ObjScan::addVertex(std::string_view rest) {
  std::array<double, 7> values{};
  size_t count = 0;
  for (std::string_view word = takeWord(rest); !word.empty() && count < values.size(); word = takeWord(rest))
    if (!parseNumber(word, values[count++])) return lines_.bad("a number", word);
  if (count < 3) return lines_.bad("three coordinates after 'v'", fmt::format("{} numbers", count));
  Vertex vertex;
  vertex.position = glm::dvec3(values[0], values[1], values[2]);
  // x y z r g b, perhaps with an alpha; four or five numbers are a weight.
  const bool hasColour = count >= 6;
  if (hasColour) vertex.colour = packColour(values[3], values[4], values[5]);
  contents_.hasColours |= hasColour;
  return contents_.vertices.append(vertex);
}

Result<> ObjScan::addCoordinates(std::string_view rest) {
  glm::vec2 at(0);  // of a curve there is u alone
  const std::string_view first = takeWord(rest), second = takeWord(rest);
  if (!parseNumber(first, at.x)) return lines_.bad("one to three numbers after 'vt'", first);
  if (!second.empty() && !parseNumber(second, at.y)) return lines_.bad("one to three numbers after 'vt'", second);
  return contents_.coordinates.append(at);
}

Result<> ObjScan::addNormal(std::string_view rest) {
  std::array<float, 3> values{};
  for (float& value : values) {
    const std::string_view word = takeWord(rest);
    if (!parseNumber(word, value)) return lines_.bad("three numbers after 'vn'", word);
  }
  return contents_.normals.append(glm::vec3(values[0], values[1], values[2]));
}

Result<> ObjScan::claimName(std::string_view name) {
  constexpr uint64_t kBytesBeside = 128;  // of a string and its place in a table
  FARCELL_ASSIGN(MemoryClaim claim, memory_->claim(name.size() + kBytesBeside,
                                                   fmt::format("{}: names of materials", lines_.file().path())));
  contents_.names.add(std::move(claim));
  return {};
}

Result<> ObjScan::countFace(std::string_view rest) {
  const ObjCounts counts{contents_.vertices.count(), contents_.coordinates.size(), contents_.normals.size()};
  uint64_t corners = 0;
  ObjCorner corner;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest), ++corners) {
    if (!parseObjCorner(word, counts, corner)) return lines_.bad("a face corner such as 7, 7/1, 7//3 or 7/1/3", word);
    contents_.everyCornerHasNormal &= corner.hasNormal;
    if (corner.hasNormal) contents_.greatestNormal = std::max(contents_.greatestNormal, corner.normal);
  }
  if (corners >= 3) contents_.triangles += corners - 2;
  if (!materialIsUsed_ && !contents_.usedMaterials.contains(material_)) {
    FARCELL_TRY(claimName(material_));
    contents_.usedMaterials.insert(material_);
  }
  materialIsUsed_ = true;
  return {};
}

class ObjReader final : public MeshReader {
 public:
  ObjReader(InputFile file, ObjContents contents, ObjMaterials materials)
      : file_(std::move(file)),
        contents_(std::move(contents)),
        materials_(std::move(materials)),
        looks_(materials_, contents_.usedMaterials) {
    info_.format = "OBJ";
    info_.up = UpAxis::y;
    info_.vertices = contents_.vertices.count();
    info_.declaredTriangles = contents_.triangles;
    info_.hasColours = contents_.hasColours || !looks_.empty();
    if (looks_.textures().empty()) contents_.coordinates.clear();
    info_.hasNormals = contents_.everyCornerHasNormal && contents_.greatestNormal < contents_.normals.size();
    if (!info_.hasNormals) contents_.normals.clear();
  }

  const MeshInfo& info() const override { return info_; }
  std::span<const TextureSource> textures() const override { return looks_.textures(); }
  std::vector<std::filesystem::path> files() const override {
    std::vector<std::filesystem::path> files = materials_.files();
    files.insert(files.begin(), file_.path());
    const std::vector<std::filesystem::path> images = looks_.files();
    files.insert(files.end(), images.begin(), images.end());
    return files;
  }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override;

 private:
  TriangleBatch::FaceLook lookOf(const ObjLook& look, const std::array<ObjCorner, 3>& corners) const;
  using Normals = std::array<glm::vec3, 3>;
  Normals normalsOf(const std::array<ObjCorner, 3>& corners) const;
  Result<> addFace(const ObjLines& lines, std::string_view rest, const ObjCounts& counts, const ObjLook& look,
                   TriangleBatch& batch) const;

  InputFile file_;
  ObjContents contents_;  // without textures no coordinates, without info().hasNormals no normals
  ObjMaterials materials_;
  ObjLooks looks_;
  MeshInfo info_;
};

// A triangle without coordinates at every corner shows no image.
TriangleBatch::FaceLook ObjReader::lookOf(const ObjLook& look, const std::array<ObjCorner, 3>& corners) const {
  if (look.texture == look.plainTexture) return {look.colour, look.plainTexture};
  TriangleBatch::FaceLook textured{look.texturedColour, look.texture};
  for (size_t k = 0; k < 3; ++k) {
    if (corners[k].coordinates >= contents_.coordinates.size()) return {look.colour, look.plainTexture};
    textured.textureCoordinates[k] = contents_.coordinates[corners[k].coordinates] * look.scale + look.offset;
  }
  return textured;
}

// Zero where the mesh has none, or the file has others by now.
ObjReader::Normals ObjReader::normalsOf(const std::array<ObjCorner, 3>& corners) const {
  Normals normals{};
  for (size_t k = 0; k < 3; ++k)
    if (corners[k].normal < contents_.normals.size()) normals[k] = contents_.normals[corners[k].normal];
  return normals;
}

// The triangles of one face, a fan around its first corner.
Result<> ObjReader::addFace(const ObjLines& lines, std::string_view rest, const ObjCounts& counts, const ObjLook& look,
                            TriangleBatch& batch) const {
  ObjCorner first;
  ObjCorner last;
  ObjCorner corner;
  uint64_t corners = 0;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest), ++corners) {
    if (!parseObjCorner(word, counts, corner)) return lines.bad("a face corner", word);
    if (corners == 0) first = corner;
    if (corners >= 2)
      batch.add({first.position, last.position, corner.position}, lookOf(look, {first, last, corner}),
                normalsOf({first, last, corner}));
    last = corner;
  }
  return {};
}

Result<MeshCounts> ObjReader::forEachTriangle(const Sink& sink) {
  TriangleBatch batch(contents_.vertices, sink);
  ObjLines lines(file_);
  ObjCounts counts;
  const ObjLook* look = &looks_.find("");
  for (std::string_view line; !batch.failed() && lines.next(line);) {
    const std::string_view keyword = takeWord(line);
    if (keyword == "v") ++counts.positions;
    if (keyword == "vt") ++counts.coordinates;
    if (keyword == "vn") ++counts.normals;
    if (keyword == "f") FARCELL_TRY(addFace(lines, line, counts, *look, batch));
    if (keyword == "usemtl") look = &looks_.find(trimmed(line));
  }
  if (lines.failure()) return tl::unexpected<Error>(*lines.failure());
  return batch.finish();
}

}  // namespace

Result<std::unique_ptr<MeshReader>> openObj(InputFile file, const std::shared_ptr<ReadMemory>& memory) {
  FARCELL_ASSIGN(ObjContents contents, ObjScan(file, memory).run());
  ObjMaterials materials(std::filesystem::path(file.path()).parent_path());
  for (const std::string& names : contents.libraries) materials.addLibraries(names);
  return std::make_unique<ObjReader>(std::move(file), std::move(contents), std::move(materials));
}

}  // namespace farcell
