// Makes one text compile as C++ (with GLM) and as GLSL. Shared functions keep to the common subset: no swizzles,
// no `out` parameters, full constructors; FARCELL_INOUT(type) is what a function changes.
#ifndef FARCELL_SHADERS_SHARED_PORTABLE_H
#define FARCELL_SHADERS_SHARED_PORTABLE_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#define FARCELL_SHARED_BEGIN  \
  namespace farcell::shared { \
  using namespace glm;
#define FARCELL_SHARED_END }
#define FARCELL_SHARED inline
#define FARCELL_CONST static constexpr
#define FARCELL_INOUT(type) type&
#else
#define FARCELL_SHARED_BEGIN
#define FARCELL_SHARED_END
#define FARCELL_SHARED
#define FARCELL_CONST const
#define FARCELL_INOUT(type) inout type
#endif

#endif
