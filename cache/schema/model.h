// What a pack says about the model and the settings it was built with: the facts baker and runtime must agree on.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "cache/schema/grid.h"
#include "cache/schema/view_form.h"

namespace farcell {

enum class UpAxis : uint32_t { x = 0, y = 1, z = 2 };

// How the meshes of inner cells are made.
enum class Simplifier : uint32_t {
  collapse = 0,  // ours
  openmesh = 1,  // OpenMesh's decimater: slower
};

// What a pack's budget is spent on first.
enum class BudgetRule : uint32_t {
  worth = 0,      // cells whose views are most worth a byte
  triangles = 1,  // cells of most triangles: the rule of the 2010 paper
};

// Which cells' image errors are measured; the others' are expected by what these have.
enum class Measure : uint8_t {
  off = 0,     // none: the pack holds no errors
  sample = 1,  // some
  all = 2,
};

// Of the impostors of cells.
enum class Forms : uint16_t {
  fixed = 0,     // all are of the settings' form
  chosen = 1,    // each cell has its own, by measured error; all views together take no more bytes than of that form
  byHeight = 2,  // by how far a cell is above the leaves (preprocess/choose/forms_by_height.h)
};

inline constexpr int kMaxViewError = 8;

// What views hold.
enum class Lighting : uint8_t {
  baked = 0,        // lit colour: of one sun, in the fewest bytes
  relightable = 1,  // albedo and mean normal: lit when drawn
};

// Where the sun stands. Azimuth: from the axis after the up axis (x, where z is up) towards the one after that;
// elevation: above the horizon.
struct Sun {
  double azimuthRad = 0.6947382761967031;    // tan: 5 / 6
  double elevationRad = 0.7307439359886967;  // tan: 7 / sqrt(61)
  bool operator==(const Sun&) const = default;
};

// Everything that decides a pack's content, besides the input itself.
struct BuildSettings {
  ViewForm form;
  Forms forms = Forms::fixed;
  int samples = 16;           // per texel: 1, 4, 16 or 64
  int leafTriangles = 16384;  // a cell of more is split, within maxLevel
  int maxLevel = 12;          // octree depth limit
  int fixedLevel = -1;        // >= 0: all leaves at this depth, as in the 2010 paper
  UpAxis up = UpAxis::z;
  double metresPerUnit = 1;
  Measure measure = Measure::sample;
  Lighting lighting = Lighting::baked;
  Sun sun;            // that baked views are lit by, and a pack where nothing else is asked for
  int viewError = 0;  // a view's channels are this near to what was baked, in 255ths: 0 (lossless)..kMaxViewError
  Simplifier simplifier = Simplifier::collapse;
  BudgetRule budgetRule = BudgetRule::worth;
  uint64_t packBudgetBytes = 0;  // 0: no limit
  uint64_t visitableHash = 0;    // of where visitors may be, XXH3-64 of the option's text and file; 0: everywhere
  bool operator==(const BuildSettings&) const = default;
};

struct Model {
  Grid grid;
  GridBox bounds;  // of all accepted triangles
  BuildSettings settings;
  bool hasNormals = false;  // the file gave vertex normals: smooth shading; else faces are flat
  bool hasColours = false;  // the file gave colours; else kDefaultAlbedo
  bool hasSides = false;    // some triangles are seen from their front only (GeometryPage::colours); needs colours
  bool operator==(const Model&) const = default;
};

// Colour of a model that brings none.
inline constexpr std::array<uint8_t, 3> kDefaultAlbedo = {204, 200, 192};

// Whether both angles are numbers, azimuth within a turn either way and elevation within a quarter of one.
bool isSun(const Sun& sun);
// Direction to the sun, unit, world axes.
glm::vec3 sunDirection(UpAxis up, const Sun& sun);
// Azimuth and elevation in degrees: "39.8056,41.8685".
std::string sunText(const Sun& sun);
// As people write them: "x", "y" or "z"; a length of mm, cm, m, km, in or ft. Nothing for other words.
std::optional<UpAxis> upAxisNamed(std::string_view name);
std::optional<Forms> formsNamed(std::string_view name);  // "fixed", "by-height", "chosen"
const char* formsName(Forms forms);
std::optional<double> metresOfUnit(std::string_view name);
// Unit vector of the up axis, and of the two others in right-handed order after it.
glm::dvec3 upVector(UpAxis up);

}  // namespace farcell
