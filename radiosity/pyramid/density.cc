#include "radiosity/pyramid/density.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

namespace lambert {
namespace {

constexpr double kDefensiveShare = 0.01;  // of f_p: bounds a ray's weight at 100 times the mean

// A pyramid that may be split.
struct Leaf {
  double worth;
  int level, index;
  // Ties by place, so that the order is the same everywhere.
  bool operator<(const Leaf& other) const {
    if (worth != other.worth) return worth < other.worth;
    if (level != other.level) return level > other.level;
    return index > other.index;
  }
};

}  // namespace

std::vector<float> CellDensities(const std::vector<double>& fractions,
                                 const std::vector<double>& worth, double alpha1, double alpha2) {
  const double total = std::accumulate(worth.begin(), worth.end(), 0.0);
  std::vector<double> density(worth.size());
  double sum = 0;
  for (size_t p = 0; p < worth.size(); ++p) {
    const double f = fractions[p], g = total > 0 ? worth[p] / total : f;
    density[p] = std::max((alpha1 * f + alpha2 * g) / (alpha1 + alpha2), kDefensiveShare * f);
    sum += density[p];
  }
  std::vector<float> result(density.size());
  for (size_t p = 0; p < density.size(); ++p) result[p] = static_cast<float>(density[p] / sum);
  return result;
}

std::vector<double> LeastVariance(const std::vector<double>& fractions,
                                  const std::vector<double>& moments) {
  std::vector<double> worth(moments.size());
  for (size_t p = 0; p < worth.size(); ++p) worth[p] = std::sqrt(fractions[p] * moments[p]);
  return worth;
}

AdaptivePyramids SplitWhereWorthIs(const Hemisphere& hemisphere, const std::vector<double>& worth,
                                   int leaves) {
  const int split = hemisphere.split();
  // Sums over the finest inside, level by level.
  std::vector<std::vector<double>> sums(hemisphere.depth() + 1);
  sums.back() = worth;
  for (int level = hemisphere.depth() - 1; level >= 0; --level) {
    sums[level].resize(hemisphere.level(level).size());
    for (size_t k = 0; k < sums[level + 1].size(); ++k) {
      sums[level][k / split] += sums[level + 1][k];
    }
  }
  std::priority_queue<Leaf> open;
  std::vector<Leaf> kept;
  for (size_t k = 0; k < sums[0].size(); ++k) open.push({sums[0][k], 0, static_cast<int>(k)});
  while (!open.empty()) {
    const Leaf leaf = open.top();
    open.pop();
    const size_t after = kept.size() + open.size() + static_cast<size_t>(split);
    if (leaf.level == hemisphere.depth() || after > static_cast<size_t>(leaves)) {
      kept.push_back(leaf);
      continue;
    }
    for (int c = 0; c < split; ++c) {
      const int child = leaf.index * split + c;
      open.push({sums[leaf.level + 1][child], leaf.level + 1, child});
    }
  }
  AdaptivePyramids result;
  for (const Leaf& leaf : kept) {
    result.pyramids.push_back(&hemisphere.level(leaf.level)[leaf.index]);
    result.worth.push_back(leaf.worth);
  }
  return result;
}

CellSpans::CellSpans(const std::vector<float>& densities) : begin_(densities.size()) {
  double sum = 0;
  for (float density : densities) sum += density;
  const double length = 0x1p32 - static_cast<double>(densities.size());
  double before = 0;
  for (size_t p = 0; p < densities.size(); ++p) {
    // One more for each cell.
    begin_[p] = static_cast<uint32_t>(before / sum * length) + static_cast<uint32_t>(p);
    before += densities[p];
  }
}

void VisitCells::Search(uint32_t ray) {
  const uint32_t* begin = spans_.begin_.data();
  const uint32_t count = std::min<uint32_t>(std::size(found_), ray_count_ - ray);
  searched_ = ray;
  // One after the other: what follows a search may have to wait for it, the next search need not.
  for (uint32_t k = 0; k < count; ++k) {
    // The last cell with no more than `ray` + k rays before it.
    size_t cell = 0;
    for (size_t left = spans_.begin_.size(); left > 1;) {
      const size_t half = left / 2;
      cell = RaysBefore(begin[cell + half]) <= ray + k ? cell + half : cell;
      left -= half;
    }
    found_[k] = static_cast<int>(cell);
  }
}

}  // namespace lambert
