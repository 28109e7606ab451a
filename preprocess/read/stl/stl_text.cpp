#include "preprocess/read/stl/stl_text.h"

#include <algorithm>
#include <cctype>

#include "preprocess/mesh/number_text.h"

namespace farcell {
namespace {

// Words across the lines of the file; keywords in either case.
class FacetWords {
 public:
  explicit FacetWords(const InputFile& file) : lines_(file, TextLines::Continuation::none) {}

  // False at the end of the file.
  bool next() {
    for (word_ = takeWord(line_); word_.empty(); word_ = takeWord(line_))
      if (!lines_.next(line_)) return false;
    return true;
  }
  bool is(std::string_view keyword) const {
    return std::equal(word_.begin(), word_.end(), keyword.begin(), keyword.end(),
                      [](char c, char lower) { return std::tolower(static_cast<unsigned char>(c)) == lower; });
  }
  void skipLine() { line_ = {}; }
  Result<> expect(std::string_view keyword) {
    if (next() && is(keyword)) return {};
    return bad(fmt::format("'{}'", keyword));
  }
  Result<> number(double& value) {
    if (next() && parseNumber(word_, value)) return {};
    return bad("a number");
  }
  Result<> vector(glm::dvec3& value) {
    for (int axis = 0; axis < 3; ++axis) FARCELL_TRY(number(value[axis]));
    return {};
  }
  // The last word, or the end of the file, in place of what was expected.
  tl::unexpected<Error> bad(const std::string& expected) const {
    return word_.empty() ? lines_.ended(expected) : lines_.bad(expected, word_);
  }
  bool atEnd() const { return word_.empty() && !lines_.failure(); }

 private:
  TextLines lines_;
  std::string_view line_;
  std::string_view word_;
};

// After "facet".
Result<std::array<glm::dvec3, 3>> facet(FacetWords& words) {
  glm::dvec3 normal;
  FARCELL_TRY(words.expect("normal"));
  FARCELL_TRY(words.vector(normal));
  FARCELL_TRY(words.expect("outer"));
  FARCELL_TRY(words.expect("loop"));
  std::array<glm::dvec3, 3> corners;
  for (glm::dvec3& corner : corners) {
    FARCELL_TRY(words.expect("vertex"));
    FARCELL_TRY(words.vector(corner));
  }
  FARCELL_TRY(words.expect("endloop"));
  FARCELL_TRY(words.expect("endfacet"));
  return corners;
}

}  // namespace

Result<> forEachTextFacet(const InputFile& file, const std::function<bool(const std::array<glm::dvec3, 3>&)>& take) {
  FacetWords words(file);
  FARCELL_TRY(words.expect("solid"));
  do {
    words.skipLine();  // the name
    while (words.next() && words.is("facet")) {
      FARCELL_ASSIGN(const auto corners, facet(words));
      if (!take(corners)) return {};
    }
    if (!words.is("endsolid")) return words.bad("'facet' or 'endsolid'");
    words.skipLine();
  } while (words.next() && words.is("solid"));
  if (words.atEnd()) return {};
  return words.bad("'solid' or the end of the file");
}

}  // namespace farcell
