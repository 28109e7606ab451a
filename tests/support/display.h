// A display without a screen for tests of windows: an Xvfb of the test's own, on a number that is free.
#pragma once

#include <memory>
#include <string>

namespace farcell {

class TestDisplay {
 public:
  // Null when Xvfb is not installed or does not come up within some seconds.
  static std::unique_ptr<TestDisplay> start();
  TestDisplay(const TestDisplay&) = delete;
  TestDisplay& operator=(const TestDisplay&) = delete;
  ~TestDisplay();

  const std::string& name() const { return name_; }  // ":7", for DISPLAY

 private:
  TestDisplay(int process, std::string name) : process_(process), name_(std::move(name)) {}
  int process_;
  std::string name_;
};

}  // namespace farcell
