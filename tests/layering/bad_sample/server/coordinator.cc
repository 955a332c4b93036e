#include "coordinator.h"

#include <grpcpp/grpcpp.h>

#include "lambert/v1/scene_service.pb.h"
#include "worker/session.h"
