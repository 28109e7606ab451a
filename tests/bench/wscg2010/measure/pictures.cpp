#include "tests/bench/wscg2010/measure/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/bench/wscg2010/measure/sheet.h"

namespace farcell::wscg {
namespace {

constexpr double kSideDistance = 0.5, kSteepDistance = 1, kCloserDistance = 0.5, kLinesDistance = 0.1;
constexpr double kCropMargin = 1.08;
constexpr double kNearShare = 0.3;  // of the cells, drawn as triangles in figure 15
constexpr uint32_t kWire = 0x40d0ff, kOutline = 0x60ff60;

// The paper's pictures are "cropped to fit the content": the same eye with the angle that just shows the model.
Camera cropped(const Scene& scene, Camera camera) {
  const CameraAxes axes = cameraAxes(camera);
  double slope = 0;
  for (const Triangle& triangle : scene.triangles) {
    for (const glm::vec3& corner : triangle.corners) {
      const glm::dvec3 toCorner = glm::dvec3(corner) - camera.position;
      const double depth = -glm::dot(toCorner, axes.back);
      const double across = std::abs(glm::dot(toCorner, axes.right)) * kPictureHeight / kPictureWidth;
      slope = std::max({slope, std::abs(glm::dot(toCorner, axes.up)) / depth, across / depth});
    }
  }
  camera.fovYRad = 2 * std::atan(kCropMargin * slope);
  return camera;
}

std::vector<Billboard> billboardsFrom(const ImpostorSet& set, const Camera& camera) {
  return set.seenFrom(camera.position);
}

void addEdge(std::vector<ColouredVertex>& lines, glm::dvec3 a, glm::dvec3 b, uint32_t colour) {
  lines.push_back({glm::vec3(a), colour});
  lines.push_back({glm::vec3(b), colour});
}

std::vector<ColouredVertex> cellEdges(const CellIndex& index) {
  std::vector<ColouredVertex> lines;
  const double half = cellHalfSide(index.depth());
  for (const CellKey& key : index.occupied()) {
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) continue;
        const auto cornerAt = [&](int c) {
          return cellCentre(key) + half * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
        };
        addEdge(lines, cornerAt(corner), cornerAt(corner | 1 << axis), kWire);
      }
    }
  }
  return lines;
}

std::vector<ColouredVertex> outlines(std::span<const Billboard> billboards) {
  std::vector<ColouredVertex> lines;
  for (const Billboard& b : billboards) {
    const std::array<glm::dvec3, 4> corners = {b.origin, b.origin + b.alongX, b.origin + b.alongX + b.alongY,
                                               b.origin + b.alongY};
    for (size_t i = 0; i < corners.size(); ++i) addEdge(lines, corners[i], corners[(i + 1) % corners.size()], kOutline);
  }
  return lines;
}

class PictureMaker {
 public:
  PictureMaker(const CellIndex& index, const FullGeometry& full, Painter painter, std::filesystem::path directory)
      : index_(index), full_(full), painter_(std::move(painter)), directory_(std::move(directory)) {}

  Result<> add(const std::string& name, Picture picture) {
    FARCELL_TRY(writePng(directory_ / fmt::format("figure-{}.png", name), picture));
    pictures_.push_back(std::move(picture));
    return {};
  }
  Result<> writeSheet() const { return writePng(directory_ / "sheet.png", contactSheet(pictures_, kSheetColumns)); }

  Picture triangles(const Camera& camera) { return pictureOf(full_.draw(painter_, camera)); }
  Result<Picture> impostors(const CellIndex& index, const Variant& variant, const Camera& camera) {
    FARCELL_ASSIGN(const ImpostorSet set, ImpostorSet::bake(index, variant.impostors, {&camera.position, 1}));
    painter_.begin(camera);
    painter_.drawBillboards(billboardsFrom(set, camera), variant.draw);
    return pictureOf(painter_.read());
  }

  Result<> singleAgainstMany();             // figure 8
  Result<> steepView();                     // 9 to 13
  Result<> closerView();                    // 16, 17
  Result<> projections();                   // 14
  Result<> blackLines();                    // 4, 7
  Result<NearTriangles> nearAsTriangles();  // 15

 private:
  Camera sideCamera(double distance) const {
    return orbitCamera(index_.scene(), levelDirections(index_.scene(), 1).front(), distance);
  }
  Camera steepCamera() const {
    return cropped(index_.scene(), orbitCamera(index_.scene(), steepDirection(index_.scene()), kSteepDistance));
  }

  const CellIndex& index_;
  const FullGeometry& full_;
  Painter painter_;
  std::filesystem::path directory_;
  std::vector<Picture> pictures_;
};

Result<> PictureMaker::singleAgainstMany() {
  const Camera camera = sideCamera(kSideDistance);
  const CellIndex whole(index_.scene(), 0);
  FARCELL_ASSIGN(Picture single, impostors(whole, paperVariant(0), camera));
  FARCELL_ASSIGN(Picture many, impostors(index_, paperVariant(index_.depth()), camera));
  const Picture truth = triangles(camera);
  const Picture singleDifference = difference(single, truth), manyDifference = difference(many, truth);
  FARCELL_TRY(add("08-single-cell", std::move(single)));
  FARCELL_TRY(add("08-many-cells", std::move(many)));
  FARCELL_TRY(add("08-single-cell-difference", singleDifference));
  return add("08-many-cells-difference", manyDifference);
}

Result<> PictureMaker::steepView() {
  const Camera camera = steepCamera();
  const Variant paper = paperVariant(index_.depth());
  painter_.begin(camera);
  painter_.drawTriangles(full_.triangles());
  painter_.drawLines(cellEdges(index_));
  FARCELL_TRY(add("09-cells", pictureOf(painter_.read())));
  FARCELL_ASSIGN(const Picture own, impostors(index_, paper, camera));
  const Picture truth = triangles(camera);
  FARCELL_TRY(add("10-impostors", own));
  FARCELL_TRY(add("11-triangles", truth));
  FARCELL_TRY(add("12-difference", difference(own, truth)));
  FARCELL_ASSIGN(const ImpostorSet set, ImpostorSet::bake(index_, paper.impostors, {&camera.position, 1}));
  const std::vector<Billboard> billboards = billboardsFrom(set, camera);
  painter_.begin(camera);
  painter_.drawBillboards(billboards, paper.draw);
  painter_.drawLines(outlines(billboards));
  return add("13-outlines", pictureOf(painter_.read()));
}

Result<NearTriangles> PictureMaker::nearAsTriangles() {
  const Camera camera = steepCamera();
  const Variant paper = paperVariant(index_.depth());
  FARCELL_ASSIGN(const ImpostorSet set, ImpostorSet::bake(index_, paper.impostors, {&camera.position, 1}));
  std::vector<double> distances;
  for (const CellKey& key : index_.occupied()) distances.push_back(glm::length(cellCentre(key) - camera.position));
  std::vector<double> sorted = distances;
  std::sort(sorted.begin(), sorted.end());
  const double threshold = sorted[static_cast<size_t>(kNearShare * static_cast<double>(sorted.size()))];
  NearTriangles result{index_.scene().name, threshold / index_.scene().radius, 0, distances.size(), 0, 0};
  std::vector<Triangle> near;
  for (size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] >= threshold) continue;
    ++result.cellsAsTriangles;
    const std::vector<Triangle> cut = index_.cut(index_.occupied()[i]);
    near.insert(near.end(), cut.begin(), cut.end());
  }
  std::vector<Billboard> far = billboardsFrom(set, camera);
  std::erase_if(far, [&](const Billboard& b) { return distances[b.cell] < threshold; });
  painter_.begin(camera);
  painter_.drawTriangles(uploadTriangles(near, index_.scene().sun));
  painter_.drawBillboards(far, paper.draw);
  const FrameImage with = painter_.read();
  painter_.begin(camera);
  painter_.drawBillboards(billboardsFrom(set, camera), paper.draw);
  const FrameImage without = painter_.read();
  const ReferenceImage reference = referenceOf(full_.draw(painter_, camera));
  result.errorWith = measureFrame(reference, with).paperError;
  result.errorWithout = measureFrame(reference, without).paperError;
  FARCELL_TRY(add("15-near-as-triangles", pictureOf(with)));
  FARCELL_TRY(add("15-near-difference", difference(pictureOf(with), triangles(camera))));
  return result;
}

Result<> PictureMaker::projections() {
  const Camera camera = cropped(index_.scene(), sideCamera(kSideDistance));
  for (const int fovDeg : {0, 40, 60, 90}) {
    Variant variant = paperVariant(index_.depth());
    variant.impostors.image.fovRad = fovDeg * std::numbers::pi / 180;
    FARCELL_ASSIGN(Picture picture, impostors(index_, variant, camera));
    FARCELL_TRY(add(fovDeg == 0 ? "14-orthographic" : fmt::format("14-perspective-{}", fovDeg), std::move(picture)));
  }
  return {};
}

Result<> PictureMaker::blackLines() {
  const Camera camera = sideCamera(kLinesDistance);
  Variant cut = paperVariant(index_.depth());
  cut.impostors.content = Content::cube;
  FARCELL_ASSIGN(Picture lines, impostors(index_, cut, camera));
  FARCELL_TRY(add("04-black-lines", std::move(lines)));
  FARCELL_ASSIGN(Picture grown, impostors(index_, paperVariant(index_.depth()), camera));
  return add("07-grown", std::move(grown));
}

Result<> PictureMaker::closerView() {
  const Camera camera = orbitCamera(index_.scene(), levelDirections(index_.scene(), 2).back(), kCloserDistance);
  FARCELL_ASSIGN(Picture own, impostors(index_, paperVariant(index_.depth()), camera));
  Picture truth = triangles(camera);
  Picture apart = difference(own, truth);
  FARCELL_TRY(add("16-impostors", std::move(own)));
  FARCELL_TRY(add("16-triangles", std::move(truth)));
  return add("17-difference", std::move(apart));
}

}  // namespace

Result<NearTriangles> drawPictures(const CellIndex& index, const FullGeometry& full,
                                   const std::filesystem::path& directory) {
  FARCELL_ASSIGN(Painter painter, Painter::create(kPictureWidth, kPictureHeight));
  PictureMaker maker(index, full, std::move(painter), directory);
  FARCELL_TRY(maker.singleAgainstMany());
  FARCELL_TRY(maker.steepView());
  FARCELL_TRY(maker.closerView());
  FARCELL_TRY(maker.projections());
  FARCELL_TRY(maker.blackLines());
  FARCELL_ASSIGN(const NearTriangles result, maker.nearAsTriangles());
  FARCELL_TRY(maker.writeSheet());
  return result;
}

}  // namespace farcell::wscg
