#include "radiosity/core/looks_down.h"
