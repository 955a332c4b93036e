#include "radiosity/output/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/core/bounds.h"

namespace lambert {
namespace {

constexpr double kDefaultAspect = 1.5;
constexpr int kProbeColumns = 24, kProbeRows = 16;  // rays that judge a view
constexpr double kSeenShare = 0.01;   // of its rays must hit something, or a camera is passed over
constexpr double kInsideAngle = 62;   // full vertical angle of views from inside [degrees]
constexpr double kOutsideAngle = 36;  // and from outside
constexpr double kDimShare = 0.05;    // of the mean radiosity: less counts as unlit
constexpr double kUnlitWeight = 0.1;  // of area that shows no light
constexpr double kThroughWeight = 0.2;  // of what is seen through the backs of one-sided patches
constexpr double kFarthest = 1e5;       // distance of a usable camera, in diagonals of the scene
constexpr double kNearlyAll = 0.9999;   // of a distance: nearer is in between
constexpr double kGrazingCosine = 0.2;  // area seen at less is not seen well
constexpr double kMargin = 1.06;        // around the scene in views from outside, and in close-ups
constexpr double kEnlargement = 3;      // of a close-up that cannot be fitted

double HalfHeight(double full_angle_degrees) {
  return std::tan(full_angle_degrees / 2 * std::numbers::pi / 180);
}

View LookAt(Vec3 eye, Vec3 target, double full_angle_degrees) {
  View view;
  view.eye = eye;
  view.forward = Normalized(target - eye);
  const Vec3 pole = std::abs(view.forward.y) < 0.999 ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  view.right = Normalized(Cross(view.forward, pole));
  view.up = Cross(view.right, view.forward);
  view.half_height = HalfHeight(full_angle_degrees);
  view.aspect = kDefaultAspect;
  return view;
}

// Views from within the box: its corners and walls, looking over the middle, and a grid of points
// at eye height that look all around (a box may hold many rooms).
void AddInsideViews(const Bounds& box, std::vector<View>& views) {
  const Vec3 size = box.Size();
  auto at = [&](double x, double y, double z) {
    return box.low + Vec3{size.x * x, size.y * y, size.z * z};
  };
  const Vec3 middle = at(0.5, 0.42, 0.5);
  for (double height : {0.5, 0.62, 0.8}) {
    for (double x : {0.04, 0.5, 0.96}) {
      for (double z : {0.04, 0.5, 0.96}) {
        if (x == 0.5 && z == 0.5) continue;
        views.push_back(LookAt(at(x, height, z), middle, kInsideAngle));
      }
    }
  }
  constexpr int kGrid = 4, kDirections = 8;
  for (int cell = 0; cell < kGrid * kGrid; ++cell) {
    const double x = (cell % kGrid + 0.5) / kGrid, z = (cell / kGrid + 0.5) / kGrid;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / kDirections;
      const Vec3 eye = at(x, 0.6, z);
      const Vec3 way{std::cos(angle), -0.12, std::sin(angle)};
      views.push_back(LookAt(eye, eye + way * box.Diagonal(), kInsideAngle));
    }
  }
  for (View& view : views) view.origin = "a view chosen inside the scene";
}

// How far from the middle of the box `view`, which looks at it, has to stand to see all of it.
double FittingDistance(const Bounds& box, const View& view) {
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 half = box.Size() * 0.5;
    const Vec3 p{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                 corner & 4 ? half.z : -half.z};
    const double across = std::abs(Dot(p, view.right)) / (view.half_height * view.aspect);
    const double along = std::abs(Dot(p, view.up)) / view.half_height;
    distance = std::max(distance, kMargin * std::max(across, along) - Dot(p, view.forward));
  }
  return distance;
}

// Views of the whole box from outside: straight at its sides and from three-quarter angles.
void AddOutsideViews(const Bounds& box, std::vector<View>& views) {
  for (double elevation : {0.0, 18.0, 35.0}) {
    for (double azimuth = 0; azimuth<360; azimuth += elevation> 0 ? 30 : 90) {
      const double e = elevation * std::numbers::pi / 180, a = azimuth * std::numbers::pi / 180;
      const Vec3 way{std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
      View view = LookAt(box.Center() + way, box.Center(), kOutsideAngle);
      view.eye = box.Center() + way * FittingDistance(box, view);
      view.origin = "a view chosen outside the scene";
      views.push_back(view);
    }
  }
}

// Half the height that a view with these axes needs to show the box, in the unit of half_height; 0
// where a corner is not in front of the eye.
double FittingHalfHeight(const Bounds& box, const View& view) {
  double half_height = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                 corner & 4 ? box.high.z : box.low.z};
    const Vec3 way = p - view.eye;
    const double depth = view.perspective ? Dot(way, view.forward) : 1;
    if (!(depth > 0)) return 0;
    half_height = std::max({half_height, std::abs(Dot(way, view.up)) / depth,
                            std::abs(Dot(way, view.right)) / (depth * view.aspect)});
  }
  return kMargin * half_height;
}

struct Sight {
  double hit_share = 0;   // of the rays
  double fill_share = 0;  // the same, without what is seen through backs
  double lit_area = 0;    // seen, weighted [m2]
};

Sight Look(const View& view, const PatchSet& patches, const RayScene& scene,
           const std::vector<double>& weight) {
  Sight sight;
  const double pixel_area = 4 * view.half_height * view.half_height * view.aspect /
                            (kProbeColumns * kProbeRows);  // at distance 1 along `forward`
  for (int pixel = 0; pixel < kProbeColumns * kProbeRows; ++pixel) {
    const View::Ray ray = view.RayThrough((pixel % kProbeColumns + 0.5) / kProbeColumns,
                                          (pixel / kProbeColumns + 0.5) / kProbeRows);
    const PictureHit hit = scene.Cast(ray.origin, ray.direction);
    if (hit.patch == kNoPatch) continue;
    sight.hit_share += 1.0 / (kProbeColumns * kProbeRows);
    const Vec3 way = Normalized(ray.direction);
    // A wall that was looked through from its back shows its front to a look the other way.
    const PictureHit back_look = scene.Cast(ray.origin + way * hit.distance_m, -way);
    const bool through =
        back_look.patch != kNoPatch && back_look.distance_m < kNearlyAll * hit.distance_m;
    const double clear = through ? kThroughWeight : 1;
    sight.fill_share += clear / (kProbeColumns * kProbeRows);
    const double off_axis = Dot(way, view.forward);
    const double facing = std::max(-Dot(way, PatchNormal(patches, hit.patch)), kGrazingCosine);
    const double solid_angle = pixel_area * off_axis * off_axis * off_axis;
    sight.lit_area +=
        clear * weight[hit.patch] * solid_angle * hit.distance_m * hit.distance_m / facing;
  }
  return sight;
}

// Cameras come from files: what they say may make no picture. Beyond kFarthest diagonals the
// float32 coordinates of rays tell nothing apart.
bool IsUsable(const View& view, const Bounds& box) {
  const double far = kFarthest * box.Diagonal();
  return IsFinite(view.right) && IsFinite(view.up) && IsFinite(view.forward) &&
         Length(view.forward) > 0 && Length(view.eye - box.Center()) < far &&
         view.half_height > 0 && std::isfinite(view.half_height) &&
         (view.perspective || view.half_height < far) && std::isfinite(view.aspect);
}

// 1 for patches that show light, kUnlitWeight for the dark.
std::vector<double> LightWeights(const PatchSet& patches, const std::vector<Rgb>& radiosity) {
  double flux = 0, area = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    flux += patches.area_m2[i] * Mean(radiosity[i]);
    area += patches.area_m2[i];
  }
  const double lit = kDimShare * flux / area;
  std::vector<double> weight(radiosity.size(), 1);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (Mean(radiosity[i]) < lit) weight[i] = kUnlitWeight;
  }
  return weight;
}

}  // namespace

View::Ray View::RayThrough(double x, double y) const {
  const Vec3 across = right * ((2 * x - 1) * half_height * aspect);
  const Vec3 along = up * ((1 - 2 * y) * half_height);
  if (perspective) return {eye, forward + across + along};
  return {eye + across + along, forward};
}

View CameraView(const Camera& camera) {
  View view;
  view.origin =
      camera.name.empty() ? "the scene's camera" : "the scene's camera '" + camera.name + "'";
  view.eye = camera.world.translation;
  view.right = camera.world.x;
  view.up = camera.world.y;
  view.forward = -camera.world.z;
  view.perspective = camera.perspective;
  view.half_height = camera.perspective ? std::tan(camera.yfov_rad / 2) : camera.half_height_m;
  view.aspect = camera.aspect > 0 ? std::clamp(camera.aspect, 0.25, 4.0) : kDefaultAspect;
  return view;
}

View Enlarged(const View& view, double factor) {
  View near = view;
  near.half_height /= factor;
  return near;
}

View CloseUp(const View& view, const Bounds& box) {
  View near = view;
  const Vec3 way = box.Center() - view.eye;
  if (view.perspective) {
    near.forward = Normalized(way);
    near.right = Normalized(Cross(near.forward, view.up));
    near.up = Cross(near.right, near.forward);
  } else {
    near.eye = view.eye + view.right * Dot(way, view.right) + view.up * Dot(way, view.up);
  }
  const double half_height = FittingHalfHeight(box, near);
  if (!(half_height > 0) || !IsFinite(near.right)) return Enlarged(view, kEnlargement);
  near.half_height = std::min(half_height, view.half_height);
  return near;
}

View ChooseView(const PatchSet& patches, const RayScene& scene,
                const std::vector<Rgb>& radiosity_lm_per_m2) {
  const std::vector<double> weight = LightWeights(patches, radiosity_lm_per_m2);
  const Bounds box = BoundsOf(patches);
  for (const Camera& camera : patches.cameras) {
    const View view = CameraView(camera);
    if (!IsUsable(view, box)) continue;
    if (Look(view, patches, scene, weight).hit_share >= kSeenShare) return view;
  }
  std::vector<View> views;
  AddInsideViews(box, views);
  AddOutsideViews(box, views);
  double best_score = -1;
  View best = views.back();
  for (const View& view : views) {
    const Sight sight = Look(view, patches, scene, weight);
    const double score = sight.lit_area * sight.fill_share;
    if (score > best_score) {
      best_score = score;
      best = view;
    }
  }
  return best;
}

}  // namespace lambert
