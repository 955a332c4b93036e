// A quantity by direction, in a table: the intensity of a lamp, or the luminance of a sky.
//
// Directions are local: z is the cosine of the angle to the table's pole, `turn` the azimuth around
// it in full turns, from x towards y. Between its nodes a table is bilinear in both, or it is one
// value a cell; beyond its nodes it is 0. Cells are rectangles in z and turn, so of equal solid
// angle where their sides are equal (Archimedes).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"

namespace lambert {

struct SphereGrid {
  bool linear = true;         // false: a value for each cell
  int channels = 1;           // or 3: r, g, b
  std::vector<double> z;      // nodes, ascending in [-1, 1], two or more
  std::vector<double> turn;   // nodes, ascending over at most 1, two or more
  std::vector<float> values;  // >= 0; by z, then turn, then channel: of nodes, or of cells
};

// Immutable; any number of threads.
class SphereTable {
 public:
  // INVALID_ARGUMENT where the grid is not as it says.
  static absl::StatusOr<std::shared_ptr<const SphereTable>> Create(SphereGrid grid);

  const SphereGrid& grid() const { return grid_; }
  // Integral over all directions, in the unit of the values times sr; one channel counts as three.
  Rgb total() const { return total_; }
  // Integral of value times max(0, z): what a surface that faces the pole receives.
  Rgb CosineTotal() const;
  // The greatest value of any channel.
  double Greatest() const;
  // Of a unit vector.
  Rgb Value(const Vec3& direction) const;

  struct Sample {
    Vec3 direction;  // unit
    double density;  // by which it was chosen [1/sr]
    Rgb value;
  };
  // A direction of two numbers in [0, 1), with density proportional to the values: of several
  // channels, to the mean of them, each over its total. Equal to the last bit on every machine.
  // Requires: total() is not {}.
  Sample Draw(double u, double v) const;

 private:
  explicit SphereTable(SphereGrid grid);
  size_t rows() const { return grid_.z.size() - 1; }
  size_t columns() const { return grid_.turn.size() - 1; }
  // Of corner (row + up, column + on) of a cell.
  double At(size_t row, size_t column, int up, int on, int channel) const;
  double Density(size_t row, size_t column, int up, int on) const;
  Rgb Inside(size_t row, size_t column, double up, double on) const;

  const SphereGrid grid_;
  Rgb total_;
  double share_[3] = {};            // of each channel in the density, by its total
  std::vector<double> row_until_;   // cumulative, of rows
  std::vector<double> cell_until_;  // cumulative within each row
};

// Azimuth of (x, y) in full turns, in (-0.5, 0.5], without libm.
double TurnOf(double x, double y);

}  // namespace lambert
