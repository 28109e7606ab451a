#include "preprocess/measure/choose_forms.h"

#include <gtest/gtest.h>

#include <random>

namespace farcell {
namespace {

// A root of eight leaves that together are all of the picture.
std::vector<CellRecord> cells(const Grid& grid) {
  std::vector<CellRecord> result(9);
  result[0] = {.key = {}, .firstChild = 1, .childCount = 8, .content = cellBox(grid, {})};
  for (uint32_t octant = 0; octant < 8; ++octant)
    result[1 + octant] = {
        .key = CellKey{}.child(octant), .parent = 0, .content = cellBox(grid, CellKey{}.child(octant))};
  return result;
}

// Errors at random, bytes as they usually are.
CellCandidates randomCandidates(std::mt19937& random) {
  std::uniform_real_distribution<double> error(10, 100), some(0.5, 2);
  CellCandidates result;
  for (size_t edge = 0; edge < kPictureEdges.size(); ++edge) {
    result.single[edge] = {200, 2};
    result.triangles[edge] = {error(random), 1};
    for (size_t i = 0; i < kCandidates; ++i)
      if (2 * kPictureEdges[edge] <= candidateForm(i).imageSize)
        result.forms[i].depthCorrected[edge] = {3 * error(random), 3};
  }
  for (size_t i = 0; i < kCandidates; ++i)
    result.forms[i].bytes = candidateForm(i).views * candidateForm(i).imageSize * some(random);
  return result;
}

// What is drawn on the way from where the root is 16 pixels large to where the leaves are 128, octave by octave.
double walkedError(const CellCandidates& root, const CellCandidates& leaf, size_t rootForm, size_t leafForm) {
  double sum = 0;
  const auto mean = [](const auto& sums, size_t edge) { return (sums[edge].mean() + sums[edge + 1].mean()) / 2 / 100; };
  for (int pixels = 32, edge = 0; pixels <= 256; pixels *= 2, ++edge) {  // the root's, at the octave's near end
    const auto at = static_cast<size_t>(edge);
    if (2 * pixels <= candidateForm(rootForm).imageSize)
      sum += mean(root.forms[rootForm].depthCorrected, at);
    else if (pixels <= candidateForm(leafForm).imageSize)  // a leaf's are half as many
      sum += mean(leaf.forms[leafForm].depthCorrected, at - 1);
    else
      sum += mean(leaf.triangles, at - 1);
  }
  return sum;
}

TEST(ChooseForms, findsTheLeastErrorThatBytesBuy) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Model model;
    model.grid = Grid{{0, 0, 0}, 1, 20};
    const std::map<uint32_t, CellCandidates> measured = {{0, randomCandidates(random)}, {3, randomCandidates(random)}};
    const ChosenForms forms = chooseForms(model, cells(model.grid), std::vector<bool>(9, true), measured);
    ASSERT_EQ(forms.kinds.size(), 2u);
    size_t fixed = 0;
    while (candidateForm(fixed) != ViewForm{42, 128}) ++fixed;
    const auto bytes = [&](size_t root, size_t leaf) {
      return measured.at(0).forms[root].bytes + 8 * measured.at(3).forms[leaf].bytes;
    };
    const auto error = [&](size_t root, size_t leaf) {
      return walkedError(measured.at(0), measured.at(3), root, leaf);
    };
    EXPECT_NEAR(forms.fixed.error, error(fixed, fixed), 1e-9);
    EXPECT_NEAR(forms.fixed.bytes, bytes(fixed, fixed), 1e-6);
    EXPECT_NEAR(forms.chosen.error, error(forms.kinds[0].chosen, forms.kinds[1].chosen), 1e-9);
    EXPECT_NEAR(forms.chosen.bytes, bytes(forms.kinds[0].chosen, forms.kinds[1].chosen), 1e-6);
    EXPECT_LE(forms.chosen.bytes, forms.fixed.bytes);
    // Of two kinds, each may round up by a step.
    const double surely = forms.fixed.bytes * (1 - 2.0 / kByteSteps);
    for (size_t root = 0; root < kCandidates; ++root)
      for (size_t leaf = 0; leaf < kCandidates; ++leaf)
        if (bytes(root, leaf) <= surely && candidateForm(leaf).imageSize >= candidateForm(root).imageSize) {
          EXPECT_LE(forms.chosen.error, error(root, leaf) + 1e-9);
        }
    for (size_t i = 1; i < forms.pareto.size(); ++i) {
      EXPECT_LT(forms.pareto[i].error, forms.pareto[i - 1].error);
      EXPECT_GT(forms.pareto[i].bytes, forms.pareto[i - 1].bytes);
    }
  }
}

TEST(ChooseForms, ofAKindThatWasNotMeasuredGoesByTheOneMostLikeIt) {
  std::mt19937 random(5);
  Model model;
  model.grid = Grid{{0, 0, 0}, 1, 20};
  const ChosenForms forms =
      chooseForms(model, cells(model.grid), std::vector<bool>(9, true), {{5, randomCandidates(random)}});
  ASSERT_EQ(forms.kinds.size(), 2u);
  EXPECT_EQ(forms.kinds[0].measured, 0u);
  EXPECT_EQ(forms.kinds[1].measured, 1u);
  EXPECT_EQ(forms.kinds[0].means.bytes, forms.kinds[1].means.bytes);
  EXPECT_TRUE(chooseForms(model, cells(model.grid), std::vector<bool>(9, true), {}).kinds.empty());
}

}  // namespace
}  // namespace farcell
