#include "radiosity/scene/ies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr double kMostValues = 1'000'000;  // of one file
constexpr double kStep_deg = 1;            // of polar angles
constexpr double kClose_deg = 1e-3;        // angles that count as the same

absl::Status BadFile(const std::string& name, const std::string& what) {
  return SceneError(name, what, "give an LM-63 file with absolute photometry of type C or B");
}

// A file as it is written: candela[h * vertical.size() + v].
struct Photometry {
  int type = 0;  // 1: C, 2: B, 3: A
  std::vector<double> vertical_deg, horizontal_deg, candela;
};

// The numbers of a file, one after the other; after the first failure all are 0.
class Numbers {
 public:
  explicit Numbers(absl::string_view text)
      : words_(absl::StrSplit(text, absl::ByAnyChar(" \t\r\n,"), absl::SkipEmpty())) {}
  double Next() {
    double value = 0;
    ok_ = ok_ && next_ < words_.size() && absl::SimpleAtod(words_[next_++], &value) &&
          std::isfinite(value);
    return ok_ ? value : 0;
  }
  std::vector<double> Next(double count) {
    std::vector<double> values;
    ok_ = ok_ && count <= static_cast<double>(words_.size() - next_);
    for (double k = 0; k < count && ok_; ++k) values.push_back(Next());
    return values;
  }
  bool ok() const { return ok_; }

 private:
  std::vector<absl::string_view> words_;
  size_t next_ = 0;
  bool ok_ = true;
};

bool IsCount(double x) { return x >= 1 && x <= kMostValues && x == std::floor(x); }

absl::StatusOr<Photometry> Parse(const std::string& name, const std::string& bytes) {
  const size_t tilt = bytes.find("TILT=");
  if (tilt == std::string::npos) return BadFile(name, "it has no line TILT=");
  const size_t line_end = bytes.find('\n', tilt);
  if (line_end == std::string::npos) return BadFile(name, "it ends after its line TILT=");
  Numbers numbers(absl::string_view(bytes).substr(line_end));
  if (absl::StartsWith(absl::string_view(bytes).substr(tilt), "TILT=INCLUDE")) {
    numbers.Next();  // how the lamp stands
    const double pairs = numbers.Next();
    numbers.Next(2 * pairs);
  }
  numbers.Next(2);  // lamps, lumens of each
  const double multiplier = numbers.Next();
  const double vertical = numbers.Next(), horizontal = numbers.Next();
  Photometry file;
  file.type = static_cast<int>(std::clamp(numbers.Next(), 0.0, 9.0));
  numbers.Next(4);  // units, width, length, height
  double factor = multiplier * numbers.Next();
  // Since 2002 the field says other things.
  const double ballast_lamp = numbers.Next();
  const bool is_old =
      !absl::StartsWith(bytes, "IES:") && !absl::StartsWith(bytes, "IESNA:LM-63-2002");
  if (is_old) factor *= ballast_lamp;
  numbers.Next();  // watts
  if (!numbers.ok()) return BadFile(name, "its head is cut off or holds what is no number");
  if (!IsCount(vertical) || !IsCount(horizontal) || vertical * horizontal > kMostValues) {
    return BadFile(name, absl::StrCat("it has ", vertical, " vertical and ", horizontal,
                                      " horizontal angles"));
  }
  file.vertical_deg = numbers.Next(vertical);
  file.horizontal_deg = numbers.Next(horizontal);
  file.candela = numbers.Next(vertical * horizontal);
  if (!numbers.ok()) return BadFile(name, "its angles or candela are cut off or are no numbers");
  for (double& candela : file.candela) {
    candela *= factor;
    if (!(candela >= 0) || candela > 1e30)
      return BadFile(name, "its candela are negative or too large");
  }
  return file;
}

// An angle and which of the file's angles it has its values from.
struct Angle {
  double deg;
  size_t from;
};

bool IsNear(double a, double b) { return std::fabs(a - b) < kClose_deg; }

// Adds `angles` turned by `sign` and `offset`, those that are there already left out.
void AddMirrored(const std::vector<double>& deg, double sign, double offset,
                 std::vector<Angle>& angles) {
  std::vector<Angle> turned;
  for (size_t k = 0; k < deg.size(); ++k) turned.push_back({offset + sign * deg[k], k});
  if (sign < 0) std::reverse(turned.begin(), turned.end());
  for (const Angle& angle : turned) {
    if (angles.empty() || !IsNear(angles.back().deg, angle.deg)) angles.push_back(angle);
  }
}

// All the way round; empty where the angles are of no known symmetry.
std::vector<Angle> AroundC(const std::vector<double>& deg) {
  std::vector<Angle> all;
  const double first = deg.front(), last = deg.back();
  if (deg.size() == 1) return {{0, 0}, {360, 0}};
  AddMirrored(deg, 1, 0, all);
  if (IsNear(first, 0) && IsNear(last, 90)) {
    AddMirrored(deg, -1, 180, all);
    AddMirrored(deg, 1, 180, all);
    AddMirrored(deg, -1, 360, all);
  } else if (IsNear(first, 0) && IsNear(last, 180)) {
    AddMirrored(deg, -1, 360, all);
  } else if (IsNear(first, 90) && IsNear(last, 270)) {
    AddMirrored(deg, -1, 540, all);
  } else if (!IsNear(first, 0) || !IsNear(last, 360)) {
    return {};
  }
  return all;
}

// From -90 to 90 degrees; empty where they are neither that nor its half.
std::vector<Angle> AcrossB(const std::vector<double>& deg) {
  std::vector<Angle> all;
  if (!IsNear(deg.back(), 90)) return {};
  if (IsNear(deg.front(), 0)) AddMirrored(deg, -1, 0, all);
  if (!all.empty() || IsNear(deg.front(), -90)) AddMirrored(deg, 1, 0, all);
  return all;
}

bool Ascend(const std::vector<double>& deg, double low, double high) {
  for (size_t k = 1; k < deg.size(); ++k) {
    if (!(deg[k] > deg[k - 1] + kClose_deg)) return false;
  }
  return deg.front() >= low - kClose_deg && deg.back() <= high + kClose_deg;
}

double Radians(double deg) { return deg * std::numbers::pi / 180; }

// A table with a row for each step of the polar angles, ascending in z.
template <typename Z, typename Candela>
SphereGrid MakeGrid(const std::vector<Angle>& polar, const std::vector<Angle>& around, Z z,
                    Candela candela) {
  SphereGrid grid;
  for (const Angle& angle : around) grid.turn.push_back(angle.deg / 360);
  const auto add_row = [&](const Angle& a, const Angle& b, double part) {
    grid.z.push_back(std::clamp(z(a.deg * (1 - part) + b.deg * part), -1.0, 1.0));
    for (const Angle& angle : around) {
      grid.values.push_back(static_cast<float>(candela(a.from, angle.from) * (1 - part) +
                                               candela(b.from, angle.from) * part));
    }
  };
  for (size_t k = 0; k + 1 < polar.size(); ++k) {
    const int steps =
        static_cast<int>(std::ceil(std::fabs(polar[k + 1].deg - polar[k].deg) / kStep_deg - 1e-6));
    for (int step = 0; step < std::max(1, steps); ++step) {
      add_row(polar[k], polar[k + 1], static_cast<double>(step) / std::max(1, steps));
    }
  }
  add_row(polar.back(), polar.back(), 0);
  return grid;
}

}  // namespace

absl::StatusOr<LampProfile> ReadIes(const std::string& name, const std::string& bytes) {
  absl::StatusOr<Photometry> file = Parse(name, bytes);
  if (!file.ok()) return file.status();
  const std::vector<double>&v = file->vertical_deg, &h = file->horizontal_deg;
  if (file->type != 1 && file->type != 2) {
    return BadFile(name, absl::StrCat("its photometry is of type ", file->type));
  }
  const bool is_c = file->type == 1;
  if (v.size() < 2 || !Ascend(v, is_c ? 0 : -90, is_c ? 180 : 90) ||
      !Ascend(h, is_c ? 0 : -90, is_c ? 360 : 90)) {
    return BadFile(name, "its angles do not ascend within their range");
  }
  const std::vector<Angle> around = is_c ? AroundC(h) : AcrossB(v);
  std::vector<Angle> polar;
  if (is_c) AddMirrored(v, -1, 0, polar);  // z = cos ascends where the angle falls
  if (!is_c) polar = AcrossB(h);
  if (around.empty() || polar.empty()) {
    return BadFile(name, "its angles are of no known symmetry");
  }
  const double rows = std::fabs(polar.back().deg - polar.front().deg) / kStep_deg +
                      2 * static_cast<double>(polar.size());
  if (rows * static_cast<double>(around.size()) > kMostValues) {
    return BadFile(name, "it has too many angles");
  }
  const auto candela = [&](size_t horizontal, size_t vertical) {
    return file->candela[horizontal * v.size() + vertical];
  };
  SphereGrid grid = is_c ? MakeGrid(
                               polar, around, [](double deg) { return std::cos(Radians(deg)); },
                               [&](size_t p, size_t a) { return candela(a, p); })
                         : MakeGrid(
                               polar, around, [](double deg) { return std::sin(Radians(deg)); },
                               [&](size_t p, size_t a) { return candela(p, a); });
  absl::StatusOr<std::shared_ptr<const SphereTable>> table = SphereTable::Create(std::move(grid));
  if (!table.ok()) return BadFile(name, "its angles are too close to each other");
  if (is_c) return LampProfile{*std::move(table), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  return LampProfile{*std::move(table), {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
}

}  // namespace lambert
