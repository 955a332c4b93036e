#  include <OpenEXR/ImfRgba.h>
#include "radiosity/scene/scene.h"
