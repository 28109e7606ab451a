#include "tests/bench/wscg2010/measure/image_store.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "cache/base/check.h"
#include "cache/pack/zlib_stream.h"
#include "tests/bench/wscg2010/measure/coders.h"

namespace farcell::wscg {
namespace {

constexpr int kZlibLevel = 6;

// A descriptor of this file's own: InputFile keeps its to itself.
class Descriptor {
 public:
  explicit Descriptor(const std::string& path) : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int fd() const { return fd_; }

 private:
  int fd_;
};

tl::unexpected<Error> refused(const std::string& path, const char* what) {
  return fail(ErrorKind::io, "{}: {}: {}", path, what, std::strerror(errno));
}

Result<double> shareInMemory(const Descriptor& descriptor, const std::string& path, uint64_t sizeBytes) {
  const auto pageBytes = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  void* mapped = mmap(nullptr, sizeBytes, PROT_READ, MAP_SHARED, descriptor.fd(), 0);
  if (mapped == MAP_FAILED) return refused(path, "mmap");
  std::vector<unsigned char> pages((sizeBytes + pageBytes - 1) / pageBytes);
  const int code = mincore(mapped, sizeBytes, pages.data());
  munmap(mapped, sizeBytes);
  if (code != 0) return refused(path, "mincore");
  const auto resident = std::count_if(pages.begin(), pages.end(), [](unsigned char page) { return (page & 1) != 0; });
  return static_cast<double>(resident) / static_cast<double>(pages.size());
}

}  // namespace

ImageStore::ImageStore(InputFile file, std::map<Key, Place> places, bool deflated)
    : file_(std::move(file)), places_(std::move(places)), deflated_(deflated) {}

Result<ImageStore> ImageStore::write(const std::filesystem::path& path, std::span<const Billboard> billboards,
                                     bool deflated) {
  std::map<Key, const CellImage*> images;
  for (const Billboard& billboard : billboards) images[{billboard.cell, billboard.view}] = billboard.image;
  FARCELL_ASSIGN(OutputFile out, OutputFile::create(path));
  std::map<Key, Place> places;
  for (const auto& [key, image] : images) {
    std::vector<std::byte> coded;
    if (deflated) {
      FARCELL_ASSIGN(coded, zlibCoded(image->rgba, kZlibLevel));
    }
    const auto bytes = deflated ? std::span<const std::byte>(coded) : std::as_bytes(std::span(image->rgba));
    places[key] = {out.sizeBytes(), bytes.size()};
    FARCELL_TRY(out.append(bytes));
  }
  FARCELL_TRY(out.commit());
  FARCELL_ASSIGN(InputFile file, InputFile::open(path));
  return ImageStore(std::move(file), std::move(places), deflated);
}

Result<size_t> ImageStore::read(const Billboard& billboard, std::vector<std::byte>& bytes) const {
  const Place place = places_.at({billboard.cell, billboard.view});
  bytes.resize(place.bytes);
  FARCELL_TRY(file_.readAt(place.offset, bytes));
  return place.bytes;
}

Result<> ImageStore::decode(const Billboard& billboard, std::span<const std::byte> bytes,
                            std::vector<uint8_t>& texels) const {
  texels.resize(billboard.image->rgba.size());
  if (deflated_) return zlibDecompress(bytes, std::as_writable_bytes(std::span(texels)));
  FARCELL_CHECK_EQ(bytes.size(), texels.size());
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  return {};
}

Result<double> ImageStore::dropFromMemory() const {
  if (file_.sizeBytes() == 0) return 0;
  const Descriptor descriptor(file_.path());
  if (descriptor.fd() < 0) return refused(file_.path(), "open");
  if (const int code = posix_fadvise(descriptor.fd(), 0, 0, POSIX_FADV_DONTNEED); code != 0)
    return fail(ErrorKind::io, "{}: posix_fadvise: {}", file_.path(), std::strerror(code));
  return shareInMemory(descriptor, file_.path(), file_.sizeBytes());
}

}  // namespace farcell::wscg
