// Lines of OBJ and MTL files.
#pragma once

#include "preprocess/mesh/text_lines.h"

namespace farcell {

struct ObjLines : TextLines {
  explicit ObjLines(const InputFile& file) : TextLines(file, Continuation::backslash) {}
};

}  // namespace farcell
