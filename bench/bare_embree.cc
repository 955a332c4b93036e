#include "bench/bare_embree.h"

#include <embree3/rtcore.h>

#include <limits>

#include "radiosity/core/vec3.h"

namespace lambert {
namespace {

// Puts ray `from` of a batch into lane `lane` of a packet.
template <typename Packet>
void PutRay(const RayBatch& batch, int from, Packet& packet, int lane) {
  packet.ray.org_x[lane] = batch.origin_x[from];
  packet.ray.org_y[lane] = batch.origin_y[from];
  packet.ray.org_z[lane] = batch.origin_z[from];
  packet.ray.dir_x[lane] = batch.direction_x[from];
  packet.ray.dir_y[lane] = batch.direction_y[from];
  packet.ray.dir_z[lane] = batch.direction_z[from];
  packet.ray.tnear[lane] = 0;
  packet.ray.time[lane] = 0;
  packet.ray.mask[lane] = ~0u;
  packet.ray.flags[lane] = 0;
}

template <typename Packet, int kWidth>
void ResetPacket(Packet& packet) {
  for (int lane = 0; lane < kWidth; ++lane) {
    packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

// All lanes but those after `count` rays.
template <int kWidth>
struct alignas(64) Valid {
  int lane[kWidth];
  explicit Valid(int64_t count) {
    for (int l = 0; l < kWidth; ++l) lane[l] = l < count ? -1 : 0;
  }
};

}  // namespace

struct BareEmbree::Impl {
  std::vector<float> vertices;
  std::vector<uint32_t> indices;
  RTCDevice device = nullptr;
  RTCScene robust = nullptr, fast = nullptr;
  int64_t rays = 0;
  std::vector<RTCRayHit16> packets16;
  std::vector<RTCRayHit8> packets8;

  RTCScene Build(RTCSceneFlags flags) const {
    RTCScene built = rtcNewScene(device);
    rtcSetSceneFlags(built, flags);
    rtcSetSceneBuildQuality(built, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices.data(), 0, 3 * sizeof(float), indices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(),
                               0, 3 * sizeof(uint32_t), indices.size() / 3);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(built, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(built);
    return built;
  }

  template <int kWidth, typename Packet>
  void Intersect(bool is_robust, std::vector<Packet>& packets,
                 void (*intersect)(const int*, RTCScene, RTCIntersectContext*, Packet*)) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const Valid<kWidth> all(kWidth), some(rays - kWidth * (std::ssize(packets) - 1));
    for (Packet& packet : packets) {
      const bool last = &packet == &packets.back();
      intersect((last ? some : all).lane, is_robust ? robust : fast, &context, &packet);
    }
  }
};

BareEmbree::BareEmbree(const PatchSet& patches, const RayScene& scene)
    : impl_(std::make_unique<Impl>()) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.is_back[i]) continue;
    for (const Vec3& corner : patches.corners[i]) {
      const Vec3 p = scene.ToTrace(corner);
      impl_->indices.push_back(static_cast<uint32_t>(impl_->indices.size()));
      impl_->vertices.insert(
          impl_->vertices.end(),
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
  }
  impl_->vertices.insert(impl_->vertices.end(), 4, 0.0f);
  impl_->device = rtcNewDevice("isa=avx2,threads=1,set_affinity=0");
  impl_->robust = impl_->Build(RTC_SCENE_FLAG_ROBUST);
  impl_->fast = impl_->Build(RTC_SCENE_FLAG_NONE);
}

BareEmbree::~BareEmbree() {
  rtcReleaseScene(impl_->robust);
  rtcReleaseScene(impl_->fast);
  rtcReleaseDevice(impl_->device);
}

void BareEmbree::SetRays(const std::vector<RayBatch>& batches) {
  impl_->rays = 0;
  for (const RayBatch& batch : batches) impl_->rays += batch.size;
  impl_->packets16.assign((impl_->rays + 15) / 16, {});
  impl_->packets8.assign((impl_->rays + 7) / 8, {});
  int64_t ray = 0;
  for (const RayBatch& batch : batches) {
    for (int slot = 0; slot < batch.size; ++slot, ++ray) {
      PutRay(batch, slot, impl_->packets16[ray / 16], static_cast<int>(ray % 16));
      PutRay(batch, slot, impl_->packets8[ray / 8], static_cast<int>(ray % 8));
    }
  }
  Reset();
}

void BareEmbree::Reset() {
  for (RTCRayHit16& packet : impl_->packets16) ResetPacket<RTCRayHit16, 16>(packet);
  for (RTCRayHit8& packet : impl_->packets8) ResetPacket<RTCRayHit8, 8>(packet);
}

void BareEmbree::Intersect16(bool robust) {
  impl_->Intersect<16>(robust, impl_->packets16, rtcIntersect16);
}

void BareEmbree::Intersect8(bool robust) {
  impl_->Intersect<8>(robust, impl_->packets8, rtcIntersect8);
}

int64_t BareEmbree::Hits16() const {
  int64_t hits = 0;
  for (const RTCRayHit16& packet : impl_->packets16) {
    for (unsigned id : packet.hit.geomID) hits += id != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

}  // namespace lambert
