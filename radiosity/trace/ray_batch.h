// Rays on their way: structure of arrays, filled by a sampler and answered by RayScene::Trace.
#pragma once

#include <cstdint>

#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

inline constexpr PatchIndex kEscaped = -1;  // RayBatch::hit of a ray that met no side of a patch
inline constexpr PatchIndex kBlocked = -2;  // RayBatch::hit of a segment that meets a triangle

struct RayBatch {
  static constexpr int kCapacity = 1024;        // a multiple of the packet width; fits the L2 cache
  static constexpr int kSlots = kCapacity + 8;  // samplers write eight rays at a time

  int size = 0;  // <= kCapacity
  // Trace coordinates (RayScene::ToTrace); directions of any length > 0.
  alignas(64) float origin_x[kSlots], origin_y[kSlots], origin_z[kSlots];
  alignas(64) float direction_x[kSlots], direction_y[kSlots], direction_z[kSlots];
  // Results: a patch or kEscaped, and of a patch where on it: the barycentric weights of its
  // corners 1 and 2, as far as float32 has it.
  alignas(64) PatchIndex hit[kSlots];
  alignas(64) float hit_u[kSlots], hit_v[kSlots];

  // One more ray, rounded to float. Requires: size < kCapacity.
  void Add(Vec3 origin, Vec3 direction) {
    origin_x[size] = static_cast<float>(origin.x);
    origin_y[size] = static_cast<float>(origin.y);
    origin_z[size] = static_cast<float>(origin.z);
    direction_x[size] = static_cast<float>(direction.x);
    direction_y[size] = static_cast<float>(direction.y);
    direction_z[size] = static_cast<float>(direction.z);
    ++size;
  }
};

}  // namespace lambert
