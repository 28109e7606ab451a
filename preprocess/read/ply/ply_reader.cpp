#include "preprocess/read/ply/ply_reader.h"

#include "preprocess/read/ply/ply_lists.h"
#include "preprocess/read/ply/ply_vertices.h"

namespace farcell {
namespace {

// An element whose rows make triangles, and where its rows start.
struct TriangleElement {
  size_t element = 0;  // of the header
  size_t list = 0;     // the property that holds the indices
  bool isStrips = false;
  PlyPlace place;
};

// What one walk through the body finds.
struct PlyBody {
  std::optional<Vertices> vertices;  // after the walk always
  std::vector<TriangleElement> triangleElements;
  uint64_t declaredTriangles = 0;
};

template <class Source, class Taker>
uint64_t visitTriangles(Source& source, const PlyElement& element, const TriangleElement& triangles, Taker& taker) {
  return triangles.isStrips ? visitRows<StripVisitor>(source, element, triangles.list, taker)
                            : visitRows<FanVisitor>(source, element, triangles.list, taker);
}

template <class Source>
tl::unexpected<Error> badRow(const Source& source, const PlyElement& element, uint64_t row) {
  return tl::unexpected<Error>(
      source.error(fmt::format("row {} of {} of element '{}'", row, element.count, element.name)));
}

Result<size_t> findIndexList(const InputFile& file, const PlyElement& element) {
  const std::optional<size_t> found =
      element.find("vertex_indices") ? element.find("vertex_indices") : element.find("vertex_index");
  if (found && element.properties[*found].countType && !isReal(element.properties[*found].type)) return *found;
  return corrupt(file.path(), 0,
                 fmt::format("a list of integers 'vertex_indices' or 'vertex_index' of element '{}'", element.name),
                 found ? "something else of that name" : "none");
}

template <class Source>
Result<> walkTriangles(Source& source, const PlyHeader& header, size_t index, PlyBody& body) {
  const PlyElement& element = header.elements[index];
  TriangleElement triangles{index, 0, element.name == "tristrips", source.place()};
  FARCELL_ASSIGN(triangles.list, findIndexList(source.file(), element));
  TriangleCounter counter;
  const uint64_t row = visitTriangles(source, element, triangles, counter);
  if (row != element.count) return badRow(source, element, row);
  body.declaredTriangles += counter.count;
  body.triangleElements.push_back(triangles);
  return {};
}

template <class Source>
Result<> skipElement(Source& source, const PlyElement& element) {
  if (!Source::kText && !element.hasLists()) {
    // readPlyHeader has checked that the product fits the file.
    if (!source.skip(PlyType::uint8, element.count * element.rowBytes())) return badRow(source, element, 0);
    return {};
  }
  if (element.properties.empty()) return {};
  for (uint64_t row = 0; row < element.count; ++row)
    for (const PlyProperty& property : element.properties)
      if (!skipProperty(source, property)) return badRow(source, element, row);
  return {};
}

template <class Source>
Result<PlyBody> walkBody(Source& source, const std::shared_ptr<const InputFile>& file, const PlyHeader& header,
                         const std::shared_ptr<ReadMemory>& memory) {
  PlyBody body;
  for (size_t i = 0; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    if (element.name == "vertex") {
      FARCELL_ASSIGN(body.vertices, readPlyVertices(source, file, element, memory));
    } else if (element.name == "face" || element.name == "tristrips") {
      FARCELL_TRY(walkTriangles(source, header, i, body));
    } else {
      FARCELL_TRY(skipElement(source, element));
    }
  }
  return body;
}

// Calls `use` with a source of the file's encoding, at `place`.
template <class Use>
auto withSource(const InputFile& file, PlyEncoding encoding, PlyPlace place, const Use& use) {
  if (encoding == PlyEncoding::ascii) {
    PlyTextSource source(file, place);
    return use(source);
  }
  if (encoding == PlyEncoding::littleEndian) {
    PlyBinarySource<false> source(file, place);
    return use(source);
  }
  PlyBinarySource<true> source(file, place);
  return use(source);
}

std::string formatName(PlyEncoding encoding) {
  if (encoding == PlyEncoding::ascii) return "PLY, ASCII";
  return encoding == PlyEncoding::littleEndian ? "PLY, binary little-endian" : "PLY, binary big-endian";
}

class PlyReader final : public MeshReader {
 public:
  PlyReader(std::shared_ptr<const InputFile> file, PlyHeader header, PlyBody body)
      : file_(std::move(file)), header_(std::move(header)), body_(std::move(body)) {
    info_.format = formatName(header_.encoding);
    info_.hasColours = body_.vertices->shape().hasColours;
    info_.hasNormals = body_.vertices->shape().hasNormals;
    info_.vertices = body_.vertices->count();
    info_.declaredTriangles = body_.declaredTriangles;
  }

  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {file_->path()}; }

  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    TriangleBatch batch(*body_.vertices, sink);
    for (const TriangleElement& triangles : body_.triangleElements) {
      const PlyElement& element = header_.elements[triangles.element];
      FARCELL_TRY(withSource(*file_, header_.encoding, triangles.place, [&](auto& source) -> Result<> {
        const uint64_t row = visitTriangles(source, element, triangles, batch);
        if (row != element.count && !batch.failed()) return badRow(source, element, row);
        return {};
      }));
    }
    return batch.finish();
  }

 private:
  std::shared_ptr<const InputFile> file_;
  PlyHeader header_;
  PlyBody body_;
  MeshInfo info_;
};

// Exactly one element 'vertex', and something that makes triangles.
Result<> checkElements(const InputFile& file, const PlyHeader& header) {
  int vertexElements = 0;
  int triangleElements = 0;
  for (const PlyElement& element : header.elements) {
    vertexElements += element.name == "vertex";
    triangleElements += element.name == "face" || element.name == "tristrips";
  }
  if (vertexElements != 1)
    return corrupt(file.path(), 0, "one element 'vertex'", fmt::format("{} of them", vertexElements));
  if (triangleElements == 0)
    return fail(ErrorKind::unsupported, "{}: expected an element 'face' or 'tristrips', found none (a point cloud?)",
                file.path());
  return {};
}

}  // namespace

Result<std::unique_ptr<MeshReader>> openPly(InputFile opened, const std::shared_ptr<ReadMemory>& memory) {
  const auto file = std::make_shared<const InputFile>(std::move(opened));
  FARCELL_ASSIGN(PlyHeader header, readPlyHeader(*file));
  FARCELL_TRY(checkElements(*file, header));
  const PlyPlace start{header.bodyOffset, header.bodyLine};
  FARCELL_ASSIGN(PlyBody body, withSource(*file, header.encoding, start,
                                          [&](auto& source) { return walkBody(source, file, header, memory); }));
  return std::make_unique<PlyReader>(file, std::move(header), std::move(body));
}

}  // namespace farcell
