// Textures in files of a test's own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "preprocess/texture/textures.h"
#include "tests/support/images/encode_image.h"

namespace farcell::test {

class TextureTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "farcell-texture.XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  TextureSource source(const std::string& name, const std::string& bytes, TextureWrap wrap = TextureWrap::repeat) {
    std::ofstream(directory_ / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    TextureSource made;
    made.file = directory_ / name;
    made.wrapU = made.wrapV = wrap;
    return made;
  }
  Textures open(const std::vector<TextureSource>& sources, int threads = 1) {
    Progress silent(false);
    work_ = directory_ / fmt::format("work{}", works_++);
    std::filesystem::create_directory(work_);
    return Textures::open(sources, work_, threads, silent).value();
  }
  // The one texture that `source` must be, and a sampler of it.
  TextureSampler& sampler(const TextureSource& from) {
    textures_ = std::make_unique<Textures>(open({from}));
    for (const Error& error : textures_->leftOut()) ADD_FAILURE() << error.message;
    sampler_ = textures_->sampler();
    return *sampler_;
  }

  std::filesystem::path directory_;
  std::filesystem::path work_;  // of the last open()
  int works_ = 0;
  std::unique_ptr<Textures> textures_;
  std::unique_ptr<TextureSampler> sampler_;
};

inline void expectNear(glm::vec4 found, glm::vec3 expected, float tolerance) {
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(found[channel], expected[channel], tolerance) << "channel " << channel;
}

}  // namespace farcell::test
