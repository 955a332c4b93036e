#include <thread>

#include "radiosity/patch/patch.h"
#include "tiny_gltf.h"

namespace lambert {
struct Unit {};
}  // namespace lambert
