#include <vector>

#include "../core/looks_down.h"
#include "absl/status/status.h"
#include "radiosity/core/looks_down.h"
#include "radiosity/nowhere.h"

namespace lambert {
struct Unit {};
}  // namespace lambert
