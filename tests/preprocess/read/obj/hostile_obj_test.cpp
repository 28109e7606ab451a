#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

BadFile badFace(const std::string& corners, const std::string& found) {
  return {std::string(kTriangle) + "f " + corners + "\n",
          "line 4: offset 24: expected a face corner such as 7, 7/1, 7//3 or 7/1/3, found '" + found + "'"};
}

TEST(HostileObj, RefusesWhatIsNotOneAndSaysWhere) {
  const TempDirectory directory;
  const std::vector<BadFile> files = {
      {"", "line 1: offset 0: expected 'v' and 'f' statements of an OBJ file, found"},
      {"# nothing\n", "line 2: offset 10: expected 'v' and 'f' statements"},
      {"a letter to a friend\nwho reads no meshes\n", "expected 'v' and 'f' statements"},
      {std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), "line 3: offset 8: expected text, found 'a zero byte'"},
      {std::string("v 0 0 0\nx\0y 1\n", 15), "line 2: offset 8: expected text, found 'a zero byte'"},
      {"v 0 0 0\nv 1 zero 0\n", "line 2: offset 8: expected a number, found 'zero'"},
      {"v 0 0 0\nv 1 0,5 0\n", "line 2: offset 8: expected a number, found '0,5'"},
      {"v 0 0 0 red 0 0\n", "line 1: offset 0: expected a number, found 'red'"},
      {"v 0 0x10 0\n", "expected a number, found '0x10'"},
      {"v 0 0 1e\n", "expected a number, found '1e'"},
      {"v 0 0 --1\n", "expected a number, found '--1'"},
      {"v 0 0 " + std::string(100'000, '1') + "x\n", "expected a number, found '1111"},
      {"v\n", "line 1: offset 0: expected three coordinates after 'v', found '0 numbers'"},
      {"v 0 0\n", "expected three coordinates after 'v', found '2 numbers'"},
      {"v 0 0 # 0\n", "expected three coordinates after 'v', found '2 numbers'"},
      {"v 0 \\\n0\n", "line 1: offset 0: expected three coordinates"},
      {"vn 0 1\nv 0 0 0\n", "line 1: offset 0: expected three numbers after 'vn', found ''"},
      {"v 0 0 0\nvn 0 up 1\n", "line 2: offset 8: expected three numbers after 'vn', found 'up'"},
      badFace("1 2 x", "x"),
      badFace("1 2 3.0", "3.0"),
      badFace("1/ /2 3", "/2"),
      badFace("1 2 3/x", "3/x"),
      badFace("1 2 3//x", "3//x"),
      badFace("1 2 3/1/1/1", "3/1/1/1"),
      badFace("1 2 /3", "/3"),
      badFace("1,2,3", "1,2,3"),
      badFace("1 2 99999999999999999999", "99999999999999999999"),
      badFace("1 2 -", "-"),
      badFace("(1 2 3)", "(1"),
  };
  for (const BadFile& file : files) expectRefused(directory, "bad.obj", file);
}

TEST(HostileObj, RefusesALineWithoutAnEnd) {
  const TempDirectory directory;
  expectRefused(directory, "long.obj",
                {"v 0 0 0\n" + std::string(size_t{65} << 20, ' '), "bytes in a line", ErrorKind::unsupported});
}

}  // namespace
}  // namespace farcell::test
