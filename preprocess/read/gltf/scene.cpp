#include "preprocess/read/gltf/scene.h"

#include <tiny_gltf.h>

#include "preprocess/read/gltf/instancing.h"
#include "preprocess/read/gltf/node_transform.h"

namespace farcell {
namespace {

constexpr size_t kMaxDepth = 4096;
constexpr uint32_t kNoParent = 0xffffffffu;

Result<> checkNode(const GltfPlace& place, int node, size_t count) {
  if (static_cast<size_t>(node) < count) return {};
  return place.bad(fmt::format("one of {} nodes", count), std::to_string(node));
}

Result<std::vector<uint32_t>> readParents(const tinygltf::Model& model, const GltfBuffers& buffers) {
  std::vector<uint32_t> parents(model.nodes.size(), kNoParent);
  for (size_t i = 0; i < model.nodes.size(); ++i)
    for (const int child : model.nodes[i].children) {
      const GltfPlace place = buffers.place(fmt::format("nodes[{}].children", i));
      FARCELL_TRY(checkNode(place, child, parents.size()));
      uint32_t& parent = parents[static_cast<size_t>(child)];
      if (parent != kNoParent)
        return place.bad("nodes of one parent each", fmt::format("node {} below node {} too", child, parent));
      parent = static_cast<uint32_t>(i);
    }
  return parents;
}

// With one parent each, nodes that no parentless one leads to go round in a cycle.
Result<> checkTree(const tinygltf::Model& model, const GltfBuffers& buffers, std::span<const uint32_t> parents) {
  std::vector<uint32_t> level;
  for (uint32_t i = 0; i < parents.size(); ++i)
    if (parents[i] == kNoParent) level.push_back(i);
  size_t found = level.size();
  for (size_t depth = 1; !level.empty(); ++depth) {
    if (depth > kMaxDepth)
      return buffers.place("nodes").failed(ErrorKind::exhausted, fmt::format("at most {} levels", kMaxDepth), "more");
    std::vector<uint32_t> next;
    for (const uint32_t node : level)
      for (const int child : model.nodes[node].children) next.push_back(static_cast<uint32_t>(child));
    found += next.size();
    level = std::move(next);
  }
  if (found == parents.size()) return {};
  return buffers.place("nodes").bad("trees", fmt::format("{} nodes in cycles", parents.size() - found));
}

Result<std::vector<uint32_t>> rootsOf(const tinygltf::Model& model, const GltfBuffers& buffers,
                                      std::span<const uint32_t> parents) {
  std::vector<bool> isRoot(parents.size(), false);
  const auto defaultScene = static_cast<size_t>(model.defaultScene);
  if (model.defaultScene >= 0 && defaultScene >= model.scenes.size())
    return buffers.place("scene").bad(fmt::format("one of {} scenes", model.scenes.size()),
                                      std::to_string(model.defaultScene));
  for (size_t i = 0; i < model.scenes.size(); ++i) {
    const GltfPlace place = buffers.place(fmt::format("scenes[{}].nodes", i));
    for (const int node : model.scenes[i].nodes) {
      FARCELL_TRY(checkNode(place, node, parents.size()));
      const auto index = static_cast<size_t>(node);
      if (parents[index] != kNoParent)
        return place.bad("roots", fmt::format("node {} below node {}", node, parents[index]));
      if (model.defaultScene < 0 || defaultScene == i) isRoot[index] = true;
    }
  }
  std::vector<uint32_t> roots;
  for (uint32_t i = 0; i < parents.size(); ++i)
    if (model.scenes.empty() ? parents[i] == kNoParent : isRoot[i]) roots.push_back(i);
  return roots;
}

struct PlacedNode {
  uint32_t node = 0;
  GltfTransform worldFromParent;
};

}  // namespace

bool GltfTransform::isMirrored() const { return glm::dot(linear[0], glm::cross(linear[1], linear[2])) < 0; }

glm::dmat3 GltfTransform::normalMatrix() const {
  // Cofactors; divided by the determinant they would be the inverse transpose, so its sign matters.
  const double sign = isMirrored() ? -1 : 1;
  return glm::dmat3(sign * glm::cross(linear[1], linear[2]), sign * glm::cross(linear[2], linear[0]),
                    sign * glm::cross(linear[0], linear[1]));
}

Result<std::vector<std::vector<GltfTransform>>> readInstances(const tinygltf::Model& model, GltfBuffers& buffers,
                                                              GltfAccessors& accessors) {
  FARCELL_ASSIGN(const std::vector<uint32_t> parents, readParents(model, buffers));
  FARCELL_TRY(checkTree(model, buffers, parents));
  FARCELL_ASSIGN(const std::vector<uint32_t> roots, rootsOf(model, buffers, parents));
  std::vector<std::vector<GltfTransform>> instances(model.meshes.size());
  std::vector<PlacedNode> open;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, {}});
  while (!open.empty()) {
    const PlacedNode placed = open.back();
    open.pop_back();
    const tinygltf::Node& node = model.nodes[placed.node];
    const GltfPlace place = buffers.place(fmt::format("nodes[{}]", placed.node));
    FARCELL_ASSIGN(const GltfTransform parentFromNode, nodeTransform(place, node));
    const GltfTransform worldFromNode = placed.worldFromParent * parentFromNode;
    if (node.mesh >= 0) {
      const auto mesh = static_cast<size_t>(node.mesh);
      if (mesh >= instances.size())
        return place.in("mesh").bad(fmt::format("one of {} meshes", instances.size()), std::to_string(node.mesh));
      FARCELL_TRY(addInstances(place, node, worldFromNode, buffers, accessors, instances[mesh]));
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      open.push_back({static_cast<uint32_t>(*child), worldFromNode});
  }
  return instances;
}

}  // namespace farcell
