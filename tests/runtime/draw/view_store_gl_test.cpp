#include "runtime/draw/view_store.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "runtime/gl/context.h"

namespace farcell {
namespace {

constexpr int kEdge = 16;
constexpr uint64_t kLayerBytes = (256 + 64 + 16 + 4 + 1) * 4 + 256;

class Views : public testing::Test {
 protected:
  void SetUp() override {
    auto created = GlContext::createHeadless();
    ASSERT_TRUE(created) << created.error().message;
    context_.emplace(std::move(*created));
  }
  std::optional<GlContext> context_;
};

// A view whose every texel holds its number.
ViewImage numbered(uint32_t view) {
  ViewImage image{.view = view, .width = kEdge, .height = kEdge, .rgba = {}, .depth = {}, .normal = {}};
  image.rgba.assign(kEdge * kEdge * 4, static_cast<uint8_t>(view));
  image.depth.assign(kEdge * kEdge, static_cast<uint8_t>(view + 1));
  return image;
}

int texelOf(GLenum unit, GLenum format, int layer, int level) {
  GLint texture = 0;
  glActiveTexture(unit);
  glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &texture);
  std::array<uint8_t, 4> texel{};
  glGetTextureSubImage(static_cast<GLuint>(texture), level, 0, 0, layer, 1, 1, 1, format, GL_UNSIGNED_BYTE, 4,
                       texel.data());
  return texel[0];
}

void expectHolds(const ViewStore& store, const ResidentView& view, uint32_t number) {
  store.bind();
  EXPECT_EQ(texelOf(GL_TEXTURE0, GL_RGBA, view.layer, 0), static_cast<int>(number));
  EXPECT_EQ(texelOf(GL_TEXTURE0, GL_RGBA, view.layer, 4), static_cast<int>(number));
  EXPECT_EQ(texelOf(GL_TEXTURE1, GL_RED, view.layer, 0), static_cast<int>(number + 1));
}

TEST_F(Views, growingKeepsWhatWasThere) {
  ViewStore store(kEdge, 1000 * kLayerBytes, false);
  store.beginPortion();
  for (uint32_t i = 0; i < 200; ++i) ASSERT_NE(store.add(7, i, numbered(i)), nullptr);
  for (uint32_t i = 0; i < 200; ++i) {
    const ResidentView* view = store.keep(7, i);
    ASSERT_NE(view, nullptr);
    expectHolds(store, *view, i);
  }
  EXPECT_LE(store.usedBytes(), 1000 * kLayerBytes);
}

TEST_F(Views, aFullBudgetRefusesUntilTheNextPortionAndNeverGrowsBeyond) {
  constexpr uint32_t kLayers = 100;
  ViewStore store(kEdge, kLayers * kLayerBytes, false);
  for (int frame = 0; frame < 4; ++frame) {
    store.beginPortion();
    for (uint32_t i = 0; i < 150; ++i) {
      const ResidentView* view = store.keep(7, i);
      if (view == nullptr) view = store.add(7, i, numbered(i));
      if (view == nullptr) {
        store.beginPortion();
        view = store.add(7, i, numbered(i));
      }
      ASSERT_NE(view, nullptr);
      expectHolds(store, *view, i);
      ASSERT_LE(store.usedBytes(), kLayers * kLayerBytes);
    }
  }
  EXPECT_EQ(store.usedBytes(), kLayers * kLayerBytes);
}

TEST_F(Views, anEmptyViewCostsNoLayer) {
  ViewStore store(kEdge, kLayerBytes, false);
  store.beginPortion();
  const ViewImage empty{.view = 0, .rgba = {}, .depth = {}, .normal = {}};
  ASSERT_NE(store.add(1, 0, empty), nullptr);
  EXPECT_EQ(store.keep(1, 0)->layer, -1);
  EXPECT_EQ(store.usedBytes(), 0u);
  EXPECT_NE(store.add(1, 1, numbered(1)), nullptr);
}

}  // namespace
}  // namespace farcell
