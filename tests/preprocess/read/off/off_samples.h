// OFF files as tests write them.
#pragma once

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {

// Every prefix that is read, a comment wherever one may stand, polygons of 0 to 5 corners and every kind of face
// colour.
inline const char* const kEveryOff =
    "# before\n\nSTCNOFF # the keyword\n# the counts\n6 8 0\n"
    "0 0 0  0 0 1  255 0 0 255  0.5 0.5 # first\n"
    "1 0 0  0 0 2  0 255 0 255  0 0\n\n"
    "1 1 0  0 1 1  0 0 255 255  0 0\n"
    "0 1 0  1 0 1  10 20 30  0 0\n"
    "0 0 1  0 0 1  1 1 1 255  0 0\n"
    "2 2 2  0 0 1  0 0 0 0  1 1\n"
    "3 0 1 2\n4 0 1 2 3 255 0 0\n# between\n5 0 1 2 3 4 # five\n3 0 1 4 7\n0\n1 5\n2 0 1\n3 2 3 4 0.5 0.5 0.5 1\n"
    "# after\n\n";

}  // namespace farcell::test
