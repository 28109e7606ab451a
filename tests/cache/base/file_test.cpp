#include "cache/base/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

namespace farcell {
namespace {

namespace fs = std::filesystem;

// A directory of its own for each test.
class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "farcell-file-test.XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    directory_ = name;
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path at(const std::string& name) const { return directory_ / name; }
  size_t fileCount() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }

  fs::path directory_;
};

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

void writePlainly(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string readPlainly(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(FileTest, ReadsExactlyTheBytesAskedForAtAnyOffset) {
  writePlainly(at("a"), "0123456789");
  const auto file = InputFile::open(at("a"));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->sizeBytes(), 10u);
  for (size_t offset = 0; offset <= 10; ++offset) {
    for (size_t size = 0; size <= 10 - offset; ++size) {
      std::string out(size, '?');
      ASSERT_TRUE(file->readAt(offset, std::as_writable_bytes(std::span(out))));
      EXPECT_EQ(out, std::string("0123456789").substr(offset, size));
    }
  }
}

TEST_F(FileTest, AReadPastTheEndIsCorruptAndNamesPathOffsetExpectedAndFound) {
  writePlainly(at("a"), "0123456789");
  const auto file = InputFile::open(at("a"));
  ASSERT_TRUE(file);
  std::string out(4, '?');
  const auto read = file->readAt(7, std::as_writable_bytes(std::span(out)));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::corrupt);
  EXPECT_EQ(read.error().message, at("a").string() + ": offset 7: expected 4 bytes, found a file of 10 bytes");
  // An offset near 2^64 must not wrap round to something valid.
  EXPECT_FALSE(file->readAt(UINT64_MAX - 1, std::as_writable_bytes(std::span(out))));
}

TEST_F(FileTest, AFileThatShrinksWhileOpenIsAnErrorNotACrash) {
  writePlainly(at("a"), std::string(100'000, 'x'));
  const auto file = InputFile::open(at("a"));
  ASSERT_TRUE(file);
  fs::resize_file(at("a"), 10'000);
  std::string out(50'000, '?');
  const auto read = file->readAt(0, std::as_writable_bytes(std::span(out)));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::corrupt);
  EXPECT_EQ(read.error().message, at("a").string() + ": offset 10000: expected 40000 more bytes, found end of file");
}

TEST_F(FileTest, AMissingFileIsNotFound) {
  const auto file = InputFile::open(at("absent"));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().kind, ErrorKind::notFound);
  EXPECT_NE(file.error().message.find(at("absent").string()), std::string::npos);
}

TEST_F(FileTest, DirectoriesFifosAndDevicesAreRefusedWithoutWaiting) {
  ASSERT_EQ(::mkfifo(at("fifo").c_str(), 0600), 0);
  for (const fs::path& path : {directory_, at("fifo"), fs::path("/dev/zero")}) {
    const auto file = InputFile::open(path);
    ASSERT_FALSE(file) << path;
    EXPECT_EQ(file.error().kind, ErrorKind::io) << path;
    EXPECT_NE(file.error().message.find("expected a regular file"), std::string::npos) << file.error().message;
  }
}

TEST_F(FileTest, AMovedInputFileKeepsReadingAndTheEmptiedOneIsHarmless) {
  writePlainly(at("a"), "first");
  writePlainly(at("b"), "second");
  auto first = InputFile::open(at("a"));
  auto second = InputFile::open(at("b"));
  ASSERT_TRUE(first && second);
  InputFile moved = std::move(*first);
  moved = std::move(*second);
  std::string out(6, '?');
  ASSERT_TRUE(moved.readAt(0, std::as_writable_bytes(std::span(out))));
  EXPECT_EQ(out, "second");
}

TEST_F(FileTest, ACommittedFileAppearsWholeAndLeavesNothingElseBehind) {
  std::string expected;
  {
    auto file = OutputFile::create(at("out"));
    ASSERT_TRUE(file) << file.error().message;
    // Pieces below, at and above the size of the write buffer (1 MiB).
    for (const size_t size : {size_t{1}, size_t{1'000'000}, size_t{1} << 20, size_t{3'000'001}}) {
      const std::string piece(size, static_cast<char>('a' + size % 26));
      ASSERT_TRUE(file->append(bytesOf(piece)));
      expected += piece;
      EXPECT_EQ(file->sizeBytes(), expected.size());
    }
    EXPECT_FALSE(fs::exists(at("out"))) << "visible before it was complete";
    ASSERT_TRUE(file->commit());
  }
  EXPECT_EQ(readPlainly(at("out")), expected);
  EXPECT_EQ(fileCount(), 1u);
}

TEST_F(FileTest, WithoutACommitAnOlderFileStaysWholeAndTheTemporaryGoes) {
  writePlainly(at("out"), "older");
  {
    auto file = OutputFile::create(at("out"));
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append(bytesOf(std::string(2'000'000, 'n'))));
    EXPECT_EQ(fileCount(), 2u);
    OutputFile moved = std::move(*file);
    EXPECT_EQ(fileCount(), 2u);
  }
  EXPECT_EQ(readPlainly(at("out")), "older");
  EXPECT_EQ(fileCount(), 1u);
}

TEST_F(FileTest, AnOlderFileSurvivesAFailedCommit) {
  writePlainly(at("out"), "older");
  auto file = OutputFile::create(at("out"));
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->append(bytesOf("newer")));
  // The temporary file is taken away: renaming it must fail and say so.
  for (const auto& entry : fs::directory_iterator(directory_))
    if (entry.path() != at("out")) fs::remove(entry.path());
  const auto committed = file->commit();
  ASSERT_FALSE(committed);
  EXPECT_NE(committed.error().message.find("cannot rename into place"), std::string::npos) << committed.error().message;
  EXPECT_EQ(readPlainly(at("out")), "older");
}

TEST_F(FileTest, WhatStandsInTheWayIsNotReplacedByAFile) {
  ASSERT_EQ(::mkfifo(at("fifo").c_str(), 0600), 0);
  for (const fs::path& path : {directory_, at("fifo"), fs::path("/dev/null")}) {
    const auto file = OutputFile::create(path);
    ASSERT_FALSE(file) << path;
    EXPECT_EQ(file.error().kind, ErrorKind::io);
  }
  EXPECT_EQ(fileCount(), 1u);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, AFileCannotBeCreatedInAMissingDirectory) {
  const auto file = OutputFile::create(at("absent") / "out");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().kind, ErrorKind::notFound);
}

TEST_F(FileTest, ACommittedFileHasThePermissionsTheUserAskedFor) {
  const mode_t old = ::umask(027);
  ASSERT_TRUE(writeTextFile(at("out"), "text"));
  ::umask(old);
  struct stat info {};
  ASSERT_EQ(::stat(at("out").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777u, 0640u);
}

// Stands for a full disk: files may not grow past 64 KiB. Exits 0 when the refusal was as it should be.
[[noreturn]] void writeTooMuch(const fs::path& path) {
  ::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{65536, 65536};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  bool asExpected = false;
  {
    auto file = OutputFile::create(path);
    const auto appended = file->append(bytesOf(std::string(size_t{2} << 20, 'x')));
    asExpected = !appended && appended.error().kind == ErrorKind::io;
    if (asExpected) std::fputs(appended.error().message.c_str(), stderr);
  }
  ::_exit(asExpected ? 0 : 1);
}

TEST_F(FileTest, AWriteTheMachineRefusesIsAnIoErrorWithItsOffsetAndLeavesNothing) {
  EXPECT_EXIT(writeTooMuch(at("out")), testing::ExitedWithCode(0), "out: cannot write at offset 65536: File too large");
  EXPECT_EQ(fileCount(), 0u);
}

TEST_F(FileTest, AScratchFileInAMissingDirectoryIsAnErrorThatNamesIt) {
  const auto scratch = ScratchFile::create(at("absent"));
  ASSERT_FALSE(scratch);
  EXPECT_EQ(scratch.error().kind, ErrorKind::notFound);
  EXPECT_NE(scratch.error().message.find(at("absent").string()), std::string::npos);
}

TEST_F(FileTest, AScratchFileHasNoNameAndReadsBackWhatWasWrittenAnywhere) {
  auto created = ScratchFile::create(directory_);
  ASSERT_TRUE(created) << created.error().message;
  EXPECT_EQ(fileCount(), 0u);
  ScratchFile scratch = std::move(*created);
  ASSERT_TRUE(scratch.writeAt(1'000'000, bytesOf("later")));
  ASSERT_TRUE(scratch.writeAt(3, bytesOf("earlier")));
  std::string out(5, '?');
  ASSERT_TRUE(scratch.readAt(1'000'000, std::as_writable_bytes(std::span(out))));
  EXPECT_EQ(out, "later");
  out.resize(10);
  ASSERT_TRUE(scratch.readAt(0, std::as_writable_bytes(std::span(out))));
  EXPECT_EQ(out, std::string("\0\0\0earlier", 10));
  EXPECT_FALSE(scratch.readAt(1'000'003, std::as_writable_bytes(std::span(out))));
}

TEST_F(FileTest, ANamedScratchFileStaysAndIsOpenedAsItIs) {
  ASSERT_TRUE(ScratchFile::open(at("s")).value().writeAt(2, bytesOf("kept")));
  ScratchFile again = ScratchFile::open(at("s")).value();
  EXPECT_EQ(again.sizeBytes().value(), 6u);
  ASSERT_TRUE(again.truncate(4));
  ASSERT_TRUE(again.sync());
  EXPECT_EQ(readTextFile(at("s"), 10).value(), std::string("\0\0ke", 4));
  const auto missing = ScratchFile::open(at("absent") / "s");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find((at("absent") / "s").string()), std::string::npos);
}

TEST_F(FileTest, ATextFileAboveTheLimitIsRefusedByItsSize) {
  ASSERT_TRUE(writeTextFile(at("t"), "0123456789"));
  EXPECT_EQ(readTextFile(at("t"), 10).value(), "0123456789");
  const auto text = readTextFile(at("t"), 9);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().kind, ErrorKind::exhausted);
  EXPECT_EQ(text.error().message, at("t").string() + ": expected at most 9 bytes, found 10");
}

TEST_F(FileTest, AnEmptyTextFileIsAnEmptyText) {
  ASSERT_TRUE(writeTextFile(at("t"), ""));
  EXPECT_EQ(readTextFile(at("t"), 0).value(), "");
}

TEST_F(FileTest, SeveralThreadsReadOneFileAtOnce) {
  std::string text;
  for (int i = 0; i < 10'000; ++i) text += fmt::format("{:08}", i);
  writePlainly(at("a"), text);
  const auto file = InputFile::open(at("a"));
  ASSERT_TRUE(file);
  std::atomic<int> wrong{0};
  {
    std::vector<std::jthread> readers;
    for (int thread = 0; thread < 4; ++thread)
      readers.emplace_back([&, thread] {
        for (int i = thread; i < 10'000; i += 4) {
          std::string out(8, '?');
          const bool read =
              file->readAt(static_cast<uint64_t>(i) * 8, std::as_writable_bytes(std::span(out))).has_value();
          if (!read || out != fmt::format("{:08}", i)) ++wrong;
        }
      });
  }
  EXPECT_EQ(wrong.load(), 0);
}

}  // namespace
}  // namespace farcell
