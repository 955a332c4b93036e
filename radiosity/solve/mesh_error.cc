#include "radiosity/solve/mesh_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace lambert {
namespace {

constexpr double kOfDifference = 3.0 / 12;
constexpr double kOnePlane = 0.9999;  // least cosine between neighbours: under one degree
constexpr size_t kMostAtEdge = 16;    // more patches at one edge are no surface

// An edge of a patch, as its ends are ordered and as it runs around the patch.
struct Side {
  Vec3 low, high;
  PatchIndex patch;
};

auto Ends(const Side& side) {
  return std::tie(side.low.x, side.low.y, side.low.z, side.high.x, side.high.y, side.high.z);
}

std::vector<Side> SortedSides(const PatchSet& patches) {
  std::vector<Side> sides;
  sides.reserve(3 * patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = patches.corners[i][k], b = patches.corners[i][(k + 1) % 3];
      const bool in_order = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
      sides.push_back({in_order ? a : b, in_order ? b : a, i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple_cat(Ends(a), std::tie(a.patch)) < std::tuple_cat(Ends(b), std::tie(b.patch));
  });
  return sides;
}

// Calls visit(i, j) for patches of one plane that share an edge.
template <typename Visit>
void ForEachNeighbours(const PatchSet& patches, Visit visit) {
  const std::vector<Side> sides = SortedSides(patches);
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && Ends(sides[end]) == Ends(sides[begin])) ++end;
    if (end - begin > kMostAtEdge) continue;
    for (size_t a = begin; a < end; ++a) {
      for (size_t b = a + 1; b < end; ++b) {
        const PatchIndex i = sides[a].patch, j = sides[b].patch;
        if (Dot(PatchNormal(patches, i), PatchNormal(patches, j)) > kOnePlane) visit(i, j);
      }
    }
  }
}

// Variance of each patch's irradiance, mean of the channels [lx^2].
std::vector<double> NoiseOf(const PatchSet& patches, const Solution& solution) {
  double flux_lm = 0, hits = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    flux_lm += Mean(solution.irradiance_lx[i]) * patches.area_m2[i];
    hits += static_cast<double>(solution.hits[i]);
  }
  std::vector<double> noise(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    // Rays that arrive are as good as independent: n of them have the relative variance 1 / n.
    const double of_ray = flux_lm / std::max(1.0, hits) / patches.area_m2[i];
    const double irradiance = Mean(solution.irradiance_lx[i]);
    const double n = std::max<double>(1, static_cast<double>(solution.hits[i]));
    double known = 0;
    for (int c = 0; c < 3; ++c) {
      const double reflectance = patches.reflectance[i][c];
      const double error = solution.std_error_lm_per_m2[i][c];
      if (reflectance > 0 && error > 0) known = std::max(known, error / reflectance);
    }
    // Over 0 also where it is all dark.
    constexpr double kLeast = 1e-300;
    noise[i] = std::max({kLeast, of_ray * of_ray, irradiance * irradiance / n, known * known});
  }
  return noise;
}

struct Difference {
  PatchIndex i, j;
  double square, noise;  // of the irradiance, mean of the channels [lx^2]
  double significance() const { return square / noise; }
};

std::vector<Difference> FindDifferences(const PatchSet& patches, const Solution& solution) {
  const std::vector<double> noise = NoiseOf(patches, solution);
  std::vector<Difference> found;
  ForEachNeighbours(patches, [&](PatchIndex i, PatchIndex j) {
    const double difference = Mean(solution.irradiance_lx[i]) - Mean(solution.irradiance_lx[j]);
    found.push_back({i, j, difference * difference, noise[i] + noise[j]});
  });
  return found;
}

void KeepSignificant(std::vector<Difference>& differences) {
  std::stable_sort(
      differences.begin(), differences.end(),
      [](const Difference& a, const Difference& b) { return a.significance() > b.significance(); });
  const auto all = static_cast<double>(differences.size());
  size_t kept = differences.size();
  for (; kept > 0; --kept) {
    const double least = 2 * std::log(all / (kFalseShare * static_cast<double>(kept)));
    if (differences[kept - 1].significance() >= least) break;
  }
  differences.resize(kept);
}

}  // namespace

MeshError EstimateMeshError(const PatchSet& patches, const Solution& solution) {
  std::vector<Difference> differences = FindDifferences(patches, solution);
  KeepSignificant(differences);
  MeshError error;
  error.squares.resize(patches.corners.size());
  for (const auto& [i, j, square, noise] : differences) {
    // Light that varies evenly does so in proportion to each one's size.
    const double size_i = std::sqrt(patches.area_m2[i]), size_j = std::sqrt(patches.area_m2[j]);
    for (const auto& [patch, size] : {std::pair(i, size_i), std::pair(j, size_j)}) {
      const double share = 2 * size / (size_i + size_j), rho = Mean(patches.reflectance[patch]);
      error.squares[patch] +=
          patches.area_m2[patch] * rho * rho * share * share * (square - noise) * kOfDifference;
    }
  }
  double area = 0, reflected = 0, squares = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    area += patches.area_m2[i];
    reflected += patches.area_m2[i] * Mean(patches.reflectance[i] * solution.irradiance_lx[i]);
    squares += error.squares[i];
  }
  if (reflected > 0) error.rms_area = std::sqrt(squares / area) / (reflected / area);
  return error;
}

}  // namespace lambert
