// A model for builds that are to take a while, or not: as many triangles as wanted.
#pragma once

#include <fmt/format.h>

#include <string>

namespace farcell::test {

// A wavy square of 2 n^2 triangles, as OBJ.
inline std::string wavyObj(int n) {
  std::string text;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) text += fmt::format("v {} {} {}\n", x, y, (x * 7 + y * 5) % 11 * 0.3);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, a + n + 1, a + 1, a + n + 2, a + n + 1);
    }
  return text;
}

}  // namespace farcell::test
