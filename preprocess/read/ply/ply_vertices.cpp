#include "preprocess/read/ply/ply_vertices.h"

#include "preprocess/read/ply/ply_lists.h"
#include "preprocess/read/ply/ply_vertex_row.h"

namespace farcell {
namespace {

template <class Source>
tl::unexpected<Error> badVertexRow(const Source& source, const PlyElement& element, uint64_t row) {
  return tl::unexpected<Error>(source.error(fmt::format("row {} of {} of element 'vertex'", row, element.count)));
}

template <class Source>
bool readRow(Source& source, const PlyElement& element, const PlyVertexRow& row, PlyVertexRow::Values& values) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const std::optional<size_t> target = row.target(i);
    const bool read = target ? source.real(property.type, values[*target]) : skipProperty(source, property);
    if (!read) return false;
  }
  return true;
}

template <class Source>
Result<Vertices> appendRows(Source& source, const PlyElement& element, const PlyVertexRow& row,
                            const std::shared_ptr<ReadMemory>& memory) {
  Vertices vertices(memory, row.shape());
  PlyVertexRow::Values values{};
  for (uint64_t i = 0; i < element.count; ++i) {
    if (!readRow(source, element, row, values)) return badVertexRow(source, element, i);
    FARCELL_TRY(vertices.append(row.vertex(values)));
  }
  return vertices;
}

// Makes rows of vertices of rows of the file.
template <bool kSwap>
class RowLoader {
 public:
  RowLoader(std::shared_ptr<const InputFile> file, uint64_t offset, PlyVertexRow row)
      : file_(std::move(file)), offset_(offset), row_(std::move(row)) {}

  Result<> operator()(uint64_t first, std::span<std::byte> out) {
    const uint64_t fileRowBytes = row_.fileRowBytes();
    const uint32_t rowBytes = row_.shape().rowBytes();
    const size_t count = out.size() / rowBytes;
    chunk_.resize(std::min<size_t>(count, std::max<size_t>(1, kChunkBytes / fileRowBytes)) * fileRowBytes);
    for (size_t done = 0; done < count;) {
      const size_t here = std::min(count - done, static_cast<size_t>(chunk_.size() / fileRowBytes));
      FARCELL_TRY(file_->readAt(offset_ + (first + done) * fileRowBytes, std::span(chunk_).first(here * fileRowBytes)));
      row_.decode<kSwap>(chunk_.data(), here, out.data() + done * rowBytes);
      done += here;
    }
    return {};
  }

 private:
  static constexpr size_t kChunkBytes = size_t{1} << 18;

  std::shared_ptr<const InputFile> file_;
  uint64_t offset_;
  PlyVertexRow row_;
  std::vector<std::byte> chunk_;
};

}  // namespace

template <class Source>
Result<Vertices> readPlyVertices(Source& source, const std::shared_ptr<const InputFile>& file,
                                 const PlyElement& element, const std::shared_ptr<ReadMemory>& memory) {
  FARCELL_ASSIGN(PlyVertexRow row, PlyVertexRow::of(*file, element));
  if constexpr (!Source::kText) {
    if (!element.hasLists()) {
      const VertexShape shape = row.shape();
      RowLoader<Source::kSwap> loader(file, source.place().offset, std::move(row));
      // readPlyHeader has checked that the product fits the file.
      if (!source.skip(PlyType::uint8, element.count * element.rowBytes())) return badVertexRow(source, element, 0);
      return Vertices::loaded(memory, shape, element.count, std::move(loader));
    }
  }
  return appendRows(source, element, row, memory);
}

template Result<Vertices> readPlyVertices(PlyBinarySource<false>&, const std::shared_ptr<const InputFile>&,
                                          const PlyElement&, const std::shared_ptr<ReadMemory>&);
template Result<Vertices> readPlyVertices(PlyBinarySource<true>&, const std::shared_ptr<const InputFile>&,
                                          const PlyElement&, const std::shared_ptr<ReadMemory>&);
template Result<Vertices> readPlyVertices(PlyTextSource&, const std::shared_ptr<const InputFile>&, const PlyElement&,
                                          const std::shared_ptr<ReadMemory>&);

}  // namespace farcell
