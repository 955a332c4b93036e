#include "radiosity/scene/sphere_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/core/sin_cos.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

absl::Status BadGrid(const std::string& what) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"TABLE_INVALID", "table of directions", what, "export its file again"});
}

bool Ascends(const std::vector<double>& nodes) {
  for (size_t k = 0; k < nodes.size(); ++k) {
    if (!std::isfinite(nodes[k]) || (k > 0 && !(nodes[k] > nodes[k - 1]))) return false;
  }
  return nodes.size() >= 2;
}

// The part of the way t at which the integral of a linear function from a to b is u of the whole.
double LinearPart(double a, double b, double u) {
  const double root = std::sqrt(a * a * (1 - u) + b * b * u);
  return a + root > 0 ? std::min(1.0, u * (a + b) / (a + root)) : u;
}

// Arc tangent of 0 <= t <= 1: two halvings of the angle, then its series.
double ArcTangent(double t) {
  for (int halving = 0; halving < 2; ++halving) t /= 1 + std::sqrt(1 + t * t);
  const double t2 = t * t;
  double sum = 0;
  for (int k = 12; k >= 0; --k) sum = 1.0 / (2 * k + 1) - t2 * sum;
  return 4 * t * sum;
}

// Finds u in ascending bounds and makes it the part of the way through its own step.
size_t Pick(const double* until, size_t count, double& u) {
  const double* at = std::upper_bound(until, until + count, u);
  size_t k = std::min<size_t>(at - until, count - 1);
  while (k > 0 && until[k] == until[k - 1]) --k;  // nothing is there
  const double before = k > 0 ? until[k - 1] : 0;
  u = std::clamp((u - before) / (until[k] - before), 0.0, 1.0);
  return k;
}

}  // namespace

double TurnOf(double x, double y) {
  const double across = std::fabs(x), along = std::fabs(y);
  if (across == 0 && along == 0) return 0;
  const bool steep = along > across;
  double turn = ArcTangent(steep ? across / along : along / across) / (2 * kPi);
  if (steep) turn = 0.25 - turn;
  if (x < 0) turn = 0.5 - turn;
  return y < 0 ? -turn : turn;
}

absl::StatusOr<std::shared_ptr<const SphereTable>> SphereTable::Create(SphereGrid grid) {
  if (!Ascends(grid.z) || grid.z.front() < -1 || grid.z.back() > 1) {
    return BadGrid("its heights do not ascend from -1 to 1");
  }
  if (!Ascends(grid.turn) || grid.turn.back() - grid.turn.front() > 1 ||
      std::fabs(grid.turn.front()) > 1) {
    return BadGrid("its azimuths do not ascend over one turn");
  }
  const size_t less = grid.linear ? 0 : 1;
  const bool fits =
      (grid.channels == 1 || grid.channels == 3) &&
      grid.values.size() / grid.channels / (grid.z.size() - less) == grid.turn.size() - less &&
      grid.values.size() % (grid.channels * (grid.z.size() - less)) == 0;
  if (!fits) return BadGrid("it has not one value for each direction and channel");
  for (float value : grid.values) {
    if (!std::isfinite(value) || value < 0) return BadGrid("a value is negative or not finite");
  }
  return std::shared_ptr<const SphereTable>(new SphereTable(std::move(grid)));
}

SphereTable::SphereTable(SphereGrid grid) : grid_(std::move(grid)) {
  const auto integral = [&](auto value) {
    double sum = 0;
    for (size_t r = 0; r < rows(); ++r) {
      for (size_t c = 0; c < columns(); ++c) {
        const double mean =
            (value(r, c, 0, 0) + value(r, c, 0, 1) + value(r, c, 1, 0) + value(r, c, 1, 1)) / 4;
        sum += mean * (grid_.z[r + 1] - grid_.z[r]) * (grid_.turn[c + 1] - grid_.turn[c]);
        cell_until_.push_back(sum);
      }
      row_until_.push_back(sum);
    }
    return sum * 2 * kPi;
  };
  for (int channel = 0; channel < 3; ++channel) {
    cell_until_.clear();
    row_until_.clear();
    total_[channel] = channel < grid_.channels ? integral([&](size_t r, size_t c, int up, int on) {
      return At(r, c, up, on, channel);
    })
                                               : total_[0];
  }
  int lit = 0;
  for (int channel = 0; channel < grid_.channels; ++channel) lit += total_[channel] > 0;
  for (int channel = 0; channel < grid_.channels; ++channel) {
    if (total_[channel] > 0) share_[channel] = 1 / (total_[channel] * lit);
  }
  cell_until_.clear();
  row_until_.clear();
  integral([&](size_t r, size_t c, int up, int on) { return Density(r, c, up, on); });
  const double all = row_until_.back();
  if (!(all > 0)) return;
  // Within each row from 0 to 1.
  for (size_t r = 0; r < rows(); ++r) {
    const double before = r > 0 ? row_until_[r - 1] : 0, row = row_until_[r] - before;
    for (size_t c = 0; c < columns() && row > 0; ++c) {
      double& until = cell_until_[r * columns() + c];
      until = (until - before) / row;
    }
  }
  for (double& until : row_until_) until /= all;
}

double SphereTable::At(size_t row, size_t column, int up, int on, int channel) const {
  const size_t index =
      grid_.linear ? (row + up) * grid_.turn.size() + column + on : row * columns() + column;
  return grid_.values[index * grid_.channels + channel];
}

double SphereTable::Density(size_t row, size_t column, int up, int on) const {
  double density = 0;
  for (int channel = 0; channel < grid_.channels; ++channel) {
    density += share_[channel] * At(row, column, up, on, channel);
  }
  return density;
}

Rgb SphereTable::Inside(size_t row, size_t column, double up, double on) const {
  Rgb value;
  for (int channel = 0; channel < 3; ++channel) {
    const int from = std::min(channel, grid_.channels - 1);
    const double low = At(row, column, 0, 0, from) * (1 - on) + At(row, column, 0, 1, from) * on;
    const double high = At(row, column, 1, 0, from) * (1 - on) + At(row, column, 1, 1, from) * on;
    value[channel] = low * (1 - up) + high * up;
  }
  return value;
}

// Simpson's rule is exact: value and cosine are linear in z.
Rgb SphereTable::CosineTotal() const {
  Rgb sum;
  for (size_t r = 0; r < rows(); ++r) {
    const double bottom = grid_.z[r], height = grid_.z[r + 1] - bottom;
    const double low = std::clamp(-bottom / height, 0.0, 1.0);  // part of the row under z = 0
    for (size_t c = 0; c < columns(); ++c) {
      const double width = 2 * kPi * (grid_.turn[c + 1] - grid_.turn[c]);
      const auto at = [&](double part) {
        return Inside(r, c, part, 0.5) * std::max(0.0, bottom + part * height);
      };
      sum = sum + (at(low) + at((low + 1) / 2) * 4 + at(1)) * (width * height * (1 - low) / 6);
    }
  }
  return sum;
}

double SphereTable::Greatest() const {
  return *std::max_element(grid_.values.begin(), grid_.values.end());
}

Rgb SphereTable::Value(const Vec3& direction) const {
  const double z = std::clamp(direction.z, -1.0, 1.0);
  double turn = TurnOf(direction.x, direction.y);
  turn -= std::floor(turn - grid_.turn.front());  // into the turn that begins with the first node
  if (z < grid_.z.front() || z > grid_.z.back() || turn > grid_.turn.back()) return {};
  const auto cell = [](const std::vector<double>& nodes, double x) {
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    return static_cast<size_t>(above - nodes.begin()) - 1;
  };
  const size_t row = cell(grid_.z, z), column = cell(grid_.turn, turn);
  return Inside(row, column, (z - grid_.z[row]) / (grid_.z[row + 1] - grid_.z[row]),
                (turn - grid_.turn[column]) / (grid_.turn[column + 1] - grid_.turn[column]));
}

SphereTable::Sample SphereTable::Draw(double u, double v) const {
  const size_t row = Pick(row_until_.data(), rows(), u);
  const size_t column = Pick(cell_until_.data() + row * columns(), columns(), v);
  const double low[2] = {Density(row, column, 0, 0), Density(row, column, 0, 1)};
  const double high[2] = {Density(row, column, 1, 0), Density(row, column, 1, 1)};
  const double up = LinearPart(low[0] + low[1], high[0] + high[1], u);
  const double start = low[0] * (1 - up) + high[0] * up, end = low[1] * (1 - up) + high[1] * up;
  const double on = LinearPart(start, end, v);
  const double z = grid_.z[row] + up * (grid_.z[row + 1] - grid_.z[row]);
  double turn = grid_.turn[column] + on * (grid_.turn[column + 1] - grid_.turn[column]);
  turn -= std::floor(turn + 0.5);
  const SineCosine angle = SinCos(2 * kPi * turn);
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return {{radius * angle.cosine, radius * angle.sine, z},
          start * (1 - on) + end * on,
          Inside(row, column, up, on)};
}

}  // namespace lambert
