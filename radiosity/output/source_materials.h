// Materials of a scene's file, written into another GLB.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "radiosity/output/glb_writer.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// Not for several threads.
class SourceMaterials {
 public:
  // Both must outlive it.
  SourceMaterials(const Appearance& appearance, GlbWriter& writer);

  // Material `index` of the file for the new one, where texture coordinates n from 1 on have the
  // number n + 1; the textures that it names are written when they are met first, and its
  // extensions are named. Extensions of materials are kept where their names begin with KHR_ or
  // EXT_. -1, or one that does not exist: white without gloss or metal.
  GlbWriter::Json Make(int index);

 private:
  void Adapt(GlbWriter::Json& value);
  void KeepExtensions(GlbWriter::Json& object, bool standard_only);
  GlbWriter::Json AddTexture(const GlbWriter::Json& index);
  GlbWriter::Json AddImage(const GlbWriter::Json& index);

  const Appearance& appearance_;
  GlbWriter& writer_;
  const GlbWriter::Json source_;
  std::map<size_t, GlbWriter::Json> textures_, images_, samplers_;  // of the file: of the new one
};

}  // namespace lambert
