#include "radiosity/output/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lambert {
namespace {

constexpr int kSubPixels = 4;          // 4 x 4 rays where neighbouring pixels differ
constexpr double kVisibleStep = 0.02;  // of the display's range: a smaller one needs no rays
constexpr Rgb kBackground{0.006, 0.007, 0.008};  // display value: near black, told from true black

constexpr double kSameSurface = 0.94;  // cosine between normals, and of the way along the surface

// Surfaces cut away that a ray passes at most, and how far behind one it goes on, in diagonals of
// the scene.
constexpr int kMostCuts = 64;
constexpr double kPassed = 1e-5;

struct Sample {
  PatchIndex patch = kNoPatch;
  Vec3 position;  // relative to the patch set's origin
  Vec3 weights;   // of the patch's corners
  TexelSurface surface;
  Rgb radiosity, irradiance, std_error;
};

// A value between those of three corners.
template <typename Value>
Value Between(const std::array<Value, 3>& corners, Vec3 weights) {
  return corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
}

// Answers rays of one picture.
class Painter {
 public:
  Painter(const View& view, const PatchSet& patches, const RayScene& scene,
          const Solution& solution, const SurfaceReader& surfaces,
          const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx)
      : view_(view),
        patches_(patches),
        scene_(scene),
        solution_(solution),
        surfaces_(surfaces),
        corner_irradiance_lx_(corner_irradiance_lx),
        passed_m_(kPassed * BoundsOf(patches).Diagonal()) {}

  Sample At(double x, double y) const {
    View::Ray ray = view_.RayThrough(x, y);
    for (int passed = 0; passed < kMostCuts; ++passed) {
      const PictureHit hit = scene_.Cast(ray.origin, ray.direction);
      if (hit.patch == kNoPatch) break;
      const Vec3 weights{std::max(1 - hit.u - hit.v, 0.0), std::max(hit.u, 0.0),
                         std::max(hit.v, 0.0)};
      if (const auto surface = surfaces_.At(hit.patch, weights)) {
        return SampleAt(hit.patch, weights, *surface);
      }
      ray.origin =
          Between(patches_.corners[hit.patch], weights) + Normalized(ray.direction) * passed_m_;
    }
    return {};
  }

  // Gives a sample another irradiance. Requires: it is of a patch.
  void Light(Rgb irradiance_lx, Sample& sample) const {
    sample.irradiance = irradiance_lx;
    sample.radiosity =
        sample.surface.exitance_lm_per_m2 + sample.surface.reflectance * irradiance_lx;
  }

  // Gives the sample of a pixel what was gathered at the nearest middle on its surface.
  void LightLikeNeighbours(int x, int y, const Picture& picture, Sample& sample) const {
    if (gathered_.empty() || sample.patch == kNoPatch) return;
    const Vec3 normal = PatchNormal(patches_, sample.patch);
    double nearest2 = std::numeric_limits<double>::infinity();
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, picture.height - 1); ++row) {
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, picture.width - 1);
           ++column) {
        const Sample& middle = gathered_[static_cast<size_t>(row) * picture.width + column];
        if (middle.patch == kNoPatch) continue;
        const Vec3 way = middle.position - sample.position;
        const double distance2 = Dot(way, way), rise = Dot(way, normal);
        if (distance2 >= nearest2 || rise * rise > (1 - kSameSurface) * distance2 ||
            Dot(PatchNormal(patches_, middle.patch), normal) < kSameSurface) {
          continue;
        }
        nearest2 = distance2;
        Light(middle.irradiance, sample);
      }
    }
  }

  void SetGathered(std::vector<Sample> middles) { gathered_ = std::move(middles); }

 private:
  Sample SampleAt(PatchIndex patch, Vec3 weights, const TexelSurface& surface) const {
    Sample sample{patch, Between(patches_.corners[patch], weights), weights, surface, {}, {}, {}};
    sample.std_error = solution_.std_error_lm_per_m2[patch];
    Light(Between(corner_irradiance_lx_[patch], weights), sample);
    return sample;
  }

  const View& view_;
  const PatchSet& patches_;
  const RayScene& scene_;
  const Solution& solution_;
  const SurfaceReader& surfaces_;
  const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx_;
  const double passed_m_;
  std::vector<Sample> gathered_;  // of the middles; empty: corner irradiance is all there is
};

Rgb Display(const Sample& sample, const Exposure& exposure) {
  return sample.patch == kNoPatch ? kBackground : Develop(sample.radiosity, exposure);
}

void SetSize(const View& view, int longer_side, Picture& picture) {
  const double width = view.aspect >= 1 ? longer_side : longer_side * view.aspect;
  picture.width = std::max(1, static_cast<int>(std::lround(width)));
  picture.height = std::max(1, static_cast<int>(std::lround(width / view.aspect)));
  const size_t pixels = static_cast<size_t>(picture.width) * picture.height;
  for (std::vector<Rgb>* layer : {&picture.radiosity_lm_per_m2, &picture.irradiance_lx,
                                  &picture.std_error_lm_per_m2, &picture.display}) {
    layer->resize(pixels);
  }
  picture.patch.resize(pixels, kNoPatch);
}

// One ray through the middle of every pixel.
std::vector<Sample> SeeMiddles(const Painter& painter, const Picture& picture) {
  std::vector<Sample> samples;
  samples.reserve(picture.patch.size());
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      samples.push_back(painter.At((x + 0.5) / picture.width, (y + 0.5) / picture.height));
    }
  }
  return samples;
}

// Fills the picture with them; the exposure is from what they see where none is given.
void DrawMiddles(const std::vector<Sample>& samples, const PictureOptions& options,
                 Picture& picture) {
  std::vector<Rgb> reflected, emitted;
  for (size_t pixel = 0; pixel < samples.size(); ++pixel) {
    const Sample& sample = samples[pixel];
    picture.patch[pixel] = sample.patch;
    picture.radiosity_lm_per_m2[pixel] = sample.radiosity;
    picture.irradiance_lx[pixel] = sample.irradiance;
    picture.std_error_lm_per_m2[pixel] = sample.std_error;
    reflected.push_back(sample.surface.reflectance * sample.irradiance);
    emitted.push_back(sample.surface.exitance_lm_per_m2);
  }
  picture.exposure = options.exposure_per_lm_per_m2 > 0 ? Exposure{options.exposure_per_lm_per_m2}
                                                        : ChooseExposure(reflected, emitted);
  picture.exposure.tone_map = options.tone_map;
  for (size_t pixel = 0; pixel < samples.size(); ++pixel) {
    picture.display[pixel] = Display(samples[pixel], picture.exposure);
  }
}

// True where a neighbour shows another value: an edge, a shadow, a steep gradient. Judged as the
// eye sees it, by sRGB values.
std::vector<bool> RoughPixels(const Picture& picture) {
  const int width = picture.width;
  std::vector<Rgb> seen(picture.display.size());
  for (size_t pixel = 0; pixel < seen.size(); ++pixel) {
    for (int channel = 0; channel < 3; ++channel) {
      seen[pixel][channel] = std::sqrt(picture.display[pixel][channel]);
    }
  }
  std::vector<bool> rough(seen.size(), false);
  auto compare = [&](size_t a, size_t b) {
    const Rgb step = seen[a] - seen[b];
    if (std::max({std::abs(step.r), std::abs(step.g), std::abs(step.b)}) < kVisibleStep) return;
    rough[a] = rough[b] = true;
  };
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t pixel = static_cast<size_t>(y) * width + x;
      if (x + 1 < width) compare(pixel, pixel + 1);
      if (y + 1 < picture.height) compare(pixel, pixel + width);
    }
  }
  return rough;
}

// Takes the radiosity of one pixel again, with kSubPixels^2 rays.
void RefinePixel(const Painter& painter, int x, int y, Picture& picture) {
  constexpr double kShare = 1.0 / (kSubPixels * kSubPixels);
  Rgb radiosity, display;
  for (int sub = 0; sub < kSubPixels * kSubPixels; ++sub) {
    // Columns are shifted from row to row, so that nearly upright edges meet all sub-columns.
    const int row = sub / kSubPixels, column = sub % kSubPixels;
    const double shift = (row + 0.5) / kSubPixels;
    Sample sample =
        painter.At((x + (column + shift) / kSubPixels) / picture.width,
                   (y + (row + (column + 0.5) / kSubPixels) / kSubPixels) / picture.height);
    painter.LightLikeNeighbours(x, y, picture, sample);
    radiosity = radiosity + sample.radiosity * kShare;
    display = display + Display(sample, picture.exposure) * kShare;
  }
  const size_t pixel = static_cast<size_t>(y) * picture.width + x;
  picture.radiosity_lm_per_m2[pixel] = radiosity;
  picture.display[pixel] = display;
}

void RefineRoughPixels(const Painter& painter, Picture& picture) {
  const std::vector<bool> rough = RoughPixels(picture);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (rough[static_cast<size_t>(y) * picture.width + x]) RefinePixel(painter, x, y, picture);
    }
  }
}

}  // namespace

Picture DrawPicture(const View& view, const PatchSet& patches, const RayScene& scene,
                    const Solution& solution, const SurfaceReader& surfaces,
                    const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx, int longer_side,
                    const PictureOptions& options) {
  Picture picture;
  SetSize(view, longer_side, picture);
  const Painter painter(view, patches, scene, solution, surfaces, corner_irradiance_lx);
  DrawMiddles(SeeMiddles(painter, picture), options, picture);
  RefineRoughPixels(painter, picture);
  return picture;
}

absl::StatusOr<Picture> DrawGatheredPicture(
    const View& view, const PatchSet& patches, const RayScene& scene, const Solution& solution,
    const SurfaceReader& surfaces, const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
    const std::vector<std::array<Vec3, 3>>& corner_normals, const GatherFunction& gather,
    int longer_side, const PictureOptions& options) {
  Picture picture;
  SetSize(view, longer_side, picture);
  Painter painter(view, patches, scene, solution, surfaces, corner_irradiance_lx);
  std::vector<Sample> samples = SeeMiddles(painter, picture);
  GatherPoints points;
  for (const Sample& sample : samples) {
    if (sample.patch == kNoPatch) continue;
    points.Add(sample.position, Normalized(Between(corner_normals[sample.patch], sample.weights)));
  }
  const absl::StatusOr<Gathered> gathered = gather(points);
  if (!gathered.ok()) return gathered.status();
  size_t next = 0;
  for (Sample& sample : samples) {
    if (sample.patch != kNoPatch) painter.Light(gathered->irradiance_lx[next++], sample);
  }
  DrawMiddles(samples, options, picture);
  painter.SetGathered(std::move(samples));
  RefineRoughPixels(painter, picture);
  return picture;
}

std::vector<std::array<Rgb, 3>> FlatIrradiance(const std::vector<Rgb>& irradiance_lx) {
  std::vector<std::array<Rgb, 3>> corners;
  corners.reserve(irradiance_lx.size());
  for (const Rgb& irradiance : irradiance_lx) {
    corners.push_back({irradiance, irradiance, irradiance});
  }
  return corners;
}

}  // namespace lambert
