#include "preprocess/mesh/paged_rows.h"

#include <algorithm>

namespace farcell {

PagedRows::PagedRows(std::shared_ptr<ReadMemory> memory, uint32_t rowBytes)
    : memory_(std::move(memory)),
      rowBytes_(rowBytes),
      shift_(static_cast<uint32_t>(std::bit_width(memory_->pageBytes() / rowBytes) - 1)),
      mask_((uint64_t{1} << shift_) - 1) {
  FARCELL_CHECK(rowBytes > 0 && rowBytes <= memory_->pageBytes());
}

Result<std::unique_ptr<PagedRows>> PagedRows::loaded(std::shared_ptr<ReadMemory> memory, uint32_t rowBytes,
                                                     uint64_t count, Load load) {
  auto rows = std::make_unique<PagedRows>(std::move(memory), rowBytes);
  FARCELL_TRY(rows->reservePages((count + rows->mask_) >> rows->shift_));
  rows->pages_.resize((count + rows->mask_) >> rows->shift_);
  rows->count_ = count;
  rows->load_ = std::move(load);
  return rows;
}

PagedRows::~PagedRows() {
  table_.shrink(0);
  for (const Page& page : pages_) {
    if (page.slot != kNoSlot) memory_->giveSlot(page.slot);
    if (page.frame != nullptr) memory_->forget(page.resident);
  }
  memory_->arena_.trim();
}

Result<> PagedRows::reservePages(uint64_t count) {
  if (count <= pages_.capacity()) return {};
  FARCELL_ASSIGN(MemoryClaim table, memory_->claim(count * kBytesPerPage, "the table of a mesh file's pages"));
  pages_.reserve(count);
  table_ = std::move(table);
  return {};
}

Result<> PagedRows::append(const void* row) {
  const uint64_t page = count_ >> shift_;
  if ((count_ & mask_) == 0) {
    if (page == pages_.capacity()) FARCELL_TRY(reservePages(std::max<uint64_t>(4, 2 * page)));
    pages_.emplace_back();
  }
  if (pages_[page].frame == nullptr) FARCELL_TRY(bringIn(page));
  pages_[page].isDirty = true;
  std::memcpy(pages_[page].frame + (count_ & mask_) * rowBytes_, row, rowBytes_);
  ++count_;
  return {};
}

std::byte* PagedRows::change(uint64_t index) {
  row(index);
  Page& page = pages_[index >> shift_];
  if (page.frame == nullptr) return zeros_.data();
  page.isDirty = true;
  return page.frame + (index & mask_) * rowBytes_;
}

Result<> PagedRows::bringIn(uint64_t page) {
  FARCELL_ASSIGN(pages_[page].frame, memory_->takePage(*this, page));
  pages_[page].resident = static_cast<uint32_t>(memory_->residents_.size() - 1);
  pages_[page].wasUsed = true;
  Result<> filled = fill(page);
  if (!filled) memory_->forget(pages_[page].resident);
  return filled;
}

// What lies elsewhere; a page never written anywhere is new.
Result<> PagedRows::fill(uint64_t page) {
  const std::span<std::byte> all(pages_[page].frame, frameBytes());
  if (pages_[page].slot != kNoSlot) return memory_->scratch_->readAt(pages_[page].slot, all);
  if (!load_) return {};
  const uint64_t first = page << shift_;
  return load_(first, all.first(std::min(mask_ + 1, count_ - first) * rowBytes_));
}

Result<> PagedRows::writeOut(uint64_t page) {
  if (!pages_[page].isDirty) return {};
  if (pages_[page].slot == kNoSlot) {
    FARCELL_ASSIGN(pages_[page].slot, memory_->takeSlot());
  }
  FARCELL_TRY(memory_->scratch_->writeAt(pages_[page].slot, std::span(pages_[page].frame, frameBytes())));
  pages_[page].isDirty = false;
  return {};
}

const std::byte* PagedRows::fault(uint64_t index) {
  if (!memory_->failure_) {
    const Result<> in = bringIn(index >> shift_);
    if (in) return pages_[index >> shift_].frame + (index & mask_) * rowBytes_;
    memory_->failure_ = in.error();
  }
  zeros_.resize(rowBytes_);
  return zeros_.data();
}

}  // namespace farcell
