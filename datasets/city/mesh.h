// The triangles of one block while they are made. World coordinates in metres, z up; seen from outside a surface,
// its corners go round counter-clockwise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace farcell::city {

struct Colour {
  uint8_t red = 0;
  uint8_t green = 0;
  uint8_t blue = 0;
};

inline Colour scaled(Colour colour, double factor) {
  const auto channel = [factor](uint8_t c) { return static_cast<uint8_t>(std::clamp(c * factor + 0.5, 0.0, 255.0)); };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

struct Vertex {
  float x = 0;
  float y = 0;
  float z = 0;
  Colour colour;
};

// Where a wall stands: x runs to the right along it (seen from outside), y up, z out of it.
struct Frame {
  glm::dvec3 origin{0};
  glm::dvec3 right{1, 0, 0};  // unit, horizontal

  glm::dvec3 outward() const { return glm::dvec3(right.y, -right.x, 0); }
  glm::dvec3 at(double x, double y, double z) const { return origin + right * x + outward() * z + glm::dvec3(0, 0, y); }
  Frame moved(double x, double y, double z) const { return {at(x, y, z), right}; }
  // The frame of the next side of a box, round its corner to the right: after `width` along this one.
  Frame turned(double width) const { return {at(width, 0, 0), -outward()}; }
};

class Mesh {
 public:
  uint32_t vertex(glm::dvec3 position, Colour colour);
  void triangle(uint32_t a, uint32_t b, uint32_t c) { triangles_.push_back({a, b, c}); }
  void triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, Colour colour);
  void quad(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d, Colour colour);
  // A box in a frame: 12 triangles.
  void box(const Frame& frame, glm::dvec3 low, glm::dvec3 high, Colour colour);
  // The band between two polygons of equally many corners (counter-clockwise seen from `to`), like a prism's sides.
  void band(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, Colour fromColour, Colour toColour);
  void fan(std::span<const glm::dvec3> polygon, Colour colour);

  std::span<const Vertex> vertices() const { return vertices_; }
  std::span<const std::array<uint32_t, 3>> triangles() const { return triangles_; }
  void clear() { truncate({}); }

  // To take back what was added since.
  struct Mark {
    size_t vertices = 0;
    size_t triangles = 0;
  };
  Mark mark() const { return {vertices_.size(), triangles_.size()}; }
  void truncate(Mark mark);

 private:
  std::vector<Vertex> vertices_;
  std::vector<std::array<uint32_t, 3>> triangles_;
};

// A regular polygon of `count` corners (6, 8 or 12), horizontal, counter-clockwise seen from above.
std::vector<glm::dvec3> polygonAround(glm::dvec3 centre, double radiusM, int count);

}  // namespace farcell::city
