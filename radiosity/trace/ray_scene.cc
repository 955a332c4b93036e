#include "radiosity/trace/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/core/lanes.h"

namespace lambert {
namespace {

// One instruction set everywhere: hits differ in their last bits between sets. Building in the
// calling thread keeps the library free of threads that it was not given.
constexpr char kDeviceConfig[] = "isa=avx2,threads=1,set_affinity=0";
constexpr size_t kPadding = 4;   // numbers: Embree may read 16 bytes at the last vertex
constexpr int kPacketWidth = 8;  // the native width of AVX2
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// What the filter of the culling scene needs of each triangle.
struct Faces {
  std::vector<PatchIndex> front;  // by Embree primitive; empty: front[k] is k, no patch has a back
  std::vector<PatchIndex> back;   // kNoPatch: one-sided

  PatchIndex Front(uint32_t primitive) const {
    return front.empty() ? static_cast<PatchIndex>(primitive) : front[primitive];
  }
};

// Vertices without most repetitions: neighbours follow each other closely, so the last of each hash
// is all that is kept in mind.
class VertexList {
 public:
  explicit VertexList(std::vector<float>* vertices) : vertices_(*vertices) {}

  // The index of these coordinates.
  uint32_t Put(const std::array<float, 3>& vertex) {
    uint32_t bits[3];
    std::memcpy(bits, vertex.data(), sizeof(bits));
    uint32_t& last = last_[(bits[0] * 73856093u ^ bits[1] * 19349663u ^ bits[2] * 83492791u) >> 16];
    const auto count = static_cast<uint32_t>(vertices_.size() / 3);
    if (last >= count || std::memcmp(&vertices_[3 * last], vertex.data(), sizeof(bits)) != 0) {
      vertices_.insert(vertices_.end(), vertex.begin(), vertex.end());
      last = count;
    }
    return last;
  }

 private:
  std::vector<float>& vertices_;
  std::vector<uint32_t> last_ = std::vector<uint32_t>(1 << 16);
};

// Rejects the backs of one-sided triangles. Embree calls it with one ray at a time here.
void CullBacks(const RTCFilterFunctionNArguments* args) {
  const Faces& faces = *static_cast<const Faces*>(args->geometryUserPtr);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const float facing = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
  if (facing > 0 && faces.back[hit->primID] == kNoPatch) args->valid[0] = 0;
}

RTCRayHit MakeRay(const float origin[3], const float direction[3]) {
  RTCRayHit ray;
  ray.ray.org_x = origin[0];
  ray.ray.org_y = origin[1];
  ray.ray.org_z = origin[2];
  ray.ray.dir_x = direction[0];
  ray.ray.dir_y = direction[1];
  ray.ray.dir_z = direction[2];
  ray.ray.tnear = 0;
  ray.ray.tfar = kInfinity;
  ray.ray.time = 0;
  ray.ray.mask = -1;
  ray.ray.id = 0;
  ray.ray.flags = 0;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

// Rays first .. first + 7 of the batch, up to `far` times their direction.
void FillPacket(const RayBatch& batch, int first, float far, RTCRay8& ray, int* valid) {
  std::memcpy(ray.org_x, batch.origin_x + first, sizeof(ray.org_x));
  std::memcpy(ray.org_y, batch.origin_y + first, sizeof(ray.org_y));
  std::memcpy(ray.org_z, batch.origin_z + first, sizeof(ray.org_z));
  std::memcpy(ray.dir_x, batch.direction_x + first, sizeof(ray.dir_x));
  std::memcpy(ray.dir_y, batch.direction_y + first, sizeof(ray.dir_y));
  std::memcpy(ray.dir_z, batch.direction_z + first, sizeof(ray.dir_z));
  for (int l = 0; l < kPacketWidth; ++l) {
    valid[l] = first + l < batch.size ? -1 : 0;
    ray.tnear[l] = 0;
    ray.tfar[l] = far;
    ray.time[l] = 0;
    ray.mask[l] = ~0u;
    ray.flags[l] = 0;
  }
}

bool HitsBack(const RTCRayHit& r) {
  return r.hit.Ng_x * r.ray.dir_x + r.hit.Ng_y * r.ray.dir_y + r.hit.Ng_z * r.ray.dir_z > 0;
}

}  // namespace

struct RayScene::Impl {
  Vec3 center;       // of the bounding box, metres relative to the patch set's origin
  double scale = 1;  // trace coordinates per metre
  Faces faces;
  std::vector<float> vertices;    // 3 each, and padding; shared with Embree
  std::vector<uint32_t> indices;  // 3 a triangle
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  // The same triangles with CullBacks, for the rays that meet a back first: built when there is
  // one, as a filter function would slow every packet down.
  mutable std::once_flag culling_once;
  mutable RTCScene culling = nullptr;

  ~Impl() {
    if (culling != nullptr) rtcReleaseScene(culling);
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void Place(const PatchSet& patches);
  RTCScene Build(bool cull_backs) const;
  RTCScene CullingScene() const;
  PictureHit SideHit(const RTCRayHit& ray) const;
  RTCRayHit CastCulled(const float origin[3], const float direction[3]) const;
  PictureHit FrontBehind(const RTCRayHit8& packet, int l) const;
  void TracePacket(RayBatch& batch, int first) const;
  void OccludePacket(RayBatch& batch, int first) const;
};

void RayScene::Impl::Place(const PatchSet& patches) {
  const Bounds bounds = BoundsOf(patches);
  center = bounds.Center();
  scale = std::ldexp(1.0, -std::ilogb(bounds.Diagonal()));
  const auto backs = std::count(patches.is_back.begin(), patches.is_back.end(), 1);
  const size_t triangles = patches.corners.size() - static_cast<size_t>(backs);
  faces.back.reserve(triangles);
  indices.reserve(3 * triangles);
  VertexList list(&vertices);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.is_back[i]) continue;
    if (backs > 0) faces.front.push_back(i);
    faces.back.push_back(patches.twin[i]);
    for (const Vec3& p : patches.corners[i]) {
      indices.push_back(list.Put(ToFloats((p - center) * scale)));
    }
  }
  vertices.insert(vertices.end(), kPadding, 0.0f);
  vertices.shrink_to_fit();
}

RTCScene RayScene::Impl::Build(bool cull_backs) const {
  RTCScene built = rtcNewScene(device);
  rtcSetSceneFlags(built, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(built, RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const size_t triangles = faces.back.size();
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             vertices.data(), 0, 3 * sizeof(float),
                             (vertices.size() - kPadding) / 3);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(),
                             0, 3 * sizeof(uint32_t), triangles);
  if (cull_backs) {
    rtcSetGeometryUserData(geometry, const_cast<Faces*>(&faces));
    rtcSetGeometryIntersectFilterFunction(geometry, CullBacks);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(built, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(built);
  return built;
}

RTCScene RayScene::Impl::CullingScene() const {
  std::call_once(culling_once, [this] { culling = Build(/*cull_backs=*/true); });
  return culling;
}

// The side that was hit and where, its distance in lengths of the direction; kNoPatch for nothing
// and for the back of a one-sided triangle.
PictureHit RayScene::Impl::SideHit(const RTCRayHit& ray) const {
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  // The back runs through its corners the other way: corners 1 and 2 change places.
  if (HitsBack(ray)) return {faces.back[ray.hit.primID], ray.hit.v, ray.hit.u, ray.ray.tfar};
  return {faces.Front(ray.hit.primID), ray.hit.u, ray.hit.v, ray.ray.tfar};
}

RTCRayHit RayScene::Impl::CastCulled(const float origin[3], const float direction[3]) const {
  RTCRayHit ray = MakeRay(origin, direction);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(CullingScene(), &context, &ray);
  return ray;
}

void RayScene::Impl::TracePacket(RayBatch& batch, int first) const {
  RTCRayHit8 packet;
  alignas(32) int valid[kPacketWidth];
  FillPacket(batch, first, kInfinity, packet.ray, valid);
  for (int l = 0; l < kPacketWidth; ++l) {
    packet.hit.geomID[l] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][l] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect8(valid, scene, &context, &packet);
  const auto load = [](const auto* from) {
    Int8 lanes;
    std::memcpy(&lanes, from, sizeof(lanes));
    return lanes;
  };
  // Lanes that are not valid have hit nothing; a batch has room for them.
  const Int8 none = Int8{} - 1;
  const Int8 hit = load(packet.hit.geomID) != none;  // RTC_INVALID_GEOMETRY_ID
  const Int8 face = hit ? load(packet.hit.primID) : Int8{};
  const Float8 facing = LoadFloat8(packet.hit.Ng_x) * LoadFloat8(packet.ray.dir_x) +
                        LoadFloat8(packet.hit.Ng_y) * LoadFloat8(packet.ray.dir_y) +
                        LoadFloat8(packet.hit.Ng_z) * LoadFloat8(packet.ray.dir_z);
  const Int8 behind = hit & (facing > 0);
  const bool any_behind = AnyLane(behind);
  Int8 side = face;
  if (!faces.front.empty()) side = Gather(faces.front.data(), face);
  if (any_behind) side = behind ? Gather(faces.back.data(), face) : side;
  side = hit ? side : none;
  std::memcpy(batch.hit + first, &side, sizeof(side));
  // A back runs through its corners the other way: corners 1 and 2 change places.
  const Float8 u = LoadFloat8(packet.hit.u), v = LoadFloat8(packet.hit.v);
  Store(behind ? v : u, batch.hit_u + first);
  Store(behind ? u : v, batch.hit_v + first);
  if (!any_behind) return;
  for (int l = 0; l < kPacketWidth; ++l) {
    if (behind[l] == 0 || side[l] != kNoPatch) continue;
    const PictureHit front = FrontBehind(packet, l);
    batch.hit[first + l] = front.patch;
    batch.hit_u[first + l] = static_cast<float>(front.u);
    batch.hit_v[first + l] = static_cast<float>(front.v);
  }
}

// What lane `l` hits, which has met the back of a one-sided triangle.
PictureHit RayScene::Impl::FrontBehind(const RTCRayHit8& packet, int l) const {
  const float origin[3] = {packet.ray.org_x[l], packet.ray.org_y[l], packet.ray.org_z[l]};
  const float direction[3] = {packet.ray.dir_x[l], packet.ray.dir_y[l], packet.ray.dir_z[l]};
  const RTCRayHit culled = CastCulled(origin, direction);
  const Vec3 d{direction[0], direction[1], direction[2]};
  const double behind = (static_cast<double>(culled.ray.tfar) - packet.ray.tfar[l]) * Length(d);
  return behind <= kTieDistance ? SideHit(culled) : PictureHit{};
}

void RayScene::Impl::OccludePacket(RayBatch& batch, int first) const {
  RTCRay8 packet;
  alignas(32) int valid[kPacketWidth];
  FillPacket(batch, first, 1, packet, valid);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(valid, scene, &context, &packet);
  for (int l = 0; l < kPacketWidth && valid[l] != 0; ++l) {
    batch.hit[first + l] = packet.tfar[l] < 0 ? kBlocked : kEscaped;  // Embree's answer is -inf
  }
}

std::string TracerPins() {
  return "embree-" + std::to_string(RTC_VERSION_MAJOR) + "." + std::to_string(RTC_VERSION_MINOR) +
         "." + std::to_string(RTC_VERSION_PATCH) + ",avx2,robust,medium";
}

absl::StatusOr<std::unique_ptr<RayScene>> RayScene::Create(const PatchSet& patches) {
  if (!__builtin_cpu_supports("avx2")) {
    return MakeError(absl::StatusCode::kFailedPrecondition,
                     {"AVX2_MISSING", "this processor", "it has no AVX2",
                      "run on an x86-64-v3 machine (2013 or later)"});
  }
  auto impl = std::make_unique<Impl>();
  impl->device = rtcNewDevice(kDeviceConfig);
  if (impl->device == nullptr) {
    return absl::InternalError("Embree: no device with '" + std::string(kDeviceConfig) + "'");
  }
  impl->Place(patches);
  impl->scene = impl->Build(/*cull_backs=*/false);
  const RTCError error = rtcGetDeviceError(impl->device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    return MakeError(absl::StatusCode::kResourceExhausted,
                     {"OUT_OF_MEMORY", "ray tracer",
                      "no memory for " + std::to_string(patches.size()) + " patches",
                      "use a larger machine or a larger --max-edge"});
  }
  if (error != RTC_ERROR_NONE) {
    return absl::InternalError("Embree: error " + std::to_string(error) + " while building");
  }
  return std::unique_ptr<RayScene>(new RayScene(std::move(impl)));
}

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::~RayScene() = default;

void RayScene::Trace(RayBatch& batch) const {
  for (int first = 0; first < batch.size; first += kPacketWidth) impl_->TracePacket(batch, first);
}

void RayScene::Occlude(RayBatch& batch) const {
  for (int first = 0; first < batch.size; first += kPacketWidth) impl_->OccludePacket(batch, first);
}

PictureHit RayScene::Cast(Vec3 origin, Vec3 direction) const {
  const RTCRayHit ray =
      impl_->CastCulled(ToFloats(ToTrace(origin)).data(), ToFloats(Normalized(direction)).data());
  PictureHit hit = impl_->SideHit(ray);
  hit.distance_m /= scale();
  return hit;
}

Vec3 RayScene::ToTrace(Vec3 point) const { return (point - impl_->center) * impl_->scale; }
double RayScene::scale() const { return impl_->scale; }

}  // namespace lambert
