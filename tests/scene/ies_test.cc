#include "radiosity/scene/ies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

// A file of LM-63-2002 with intensity(vertical, horizontal) in degrees.
std::string File(int type, const std::vector<double>& vertical,
                 const std::vector<double>& horizontal,
                 const std::function<double(double, double)>& intensity,
                 const std::string& head = "IESNA:LM-63-2002\n[TEST] made\n",
                 const std::string& factors = "1 1 0") {
  std::string text = absl::StrCat(head, "TILT=NONE\n1 1000 1 ", vertical.size(), " ",
                                  horizontal.size(), " ", type, " 2 0 0 0\n", factors, "\n");
  for (double v : vertical) absl::StrAppend(&text, v, " ");
  for (double h : horizontal) absl::StrAppend(&text, "\n", h);
  for (double h : horizontal) {
    for (double v : vertical) absl::StrAppend(&text, "\n", intensity(v, h));
  }
  return text + "\n";
}

LampProfile Read(const std::string& bytes) {
  auto profile = ReadIes("lamp.ies", bytes);
  EXPECT_TRUE(profile.ok()) << profile.status();
  return *profile;
}

// In the lamp's own axes: it aims along -z.
double Toward(const LampProfile& lamp, Vec3 d) {
  d = Normalized(d);
  return lamp.intensity_cd->Value({Dot(d, lamp.x), Dot(d, lamp.y), Dot(d, lamp.z)}).r;
}

std::vector<double> Steps(double low, double high, double step) {
  std::vector<double> steps;
  for (double x = low; x <= high + step / 2; x += step) steps.push_back(x);
  return steps;
}

double Cosine(double deg) { return std::max(0.0, std::cos(deg * kPi / 180)); }

TEST(ReadIes, TheSameAllAroundIsAPointLight) {
  const LampProfile lamp = Read(File(1, {0, 90, 180}, {0}, [](double, double) { return 50; }));
  EXPECT_NEAR(lamp.intensity_cd->total().r, 4 * kPi * 50, 1e-9);
  for (Vec3 d : {Vec3{0, 0, -1}, {0, 0, 1}, {1, 2, 3}, {-1, 0.1, 0}})
    EXPECT_EQ(Toward(lamp, d), 50);
}

TEST(ReadIes, ADownlightByTheCosineSendsPiTimesItsIntensity) {
  const LampProfile lamp =
      Read(File(1, Steps(0, 90, 1), {0}, [](double v, double) { return 100 * Cosine(v); }));
  EXPECT_NEAR(lamp.intensity_cd->total().r, 100 * kPi, 0.02);
  EXPECT_EQ(Toward(lamp, {0, 0, -1}), 100);
  EXPECT_NEAR(Toward(lamp, {0.6, 0, -0.8}), 80, 0.01);
  EXPECT_EQ(Toward(lamp, {0.6, 0, 0.8}), 0);
}

TEST(ReadIes, IntensityIsTimesItsFactors) {
  const auto fifty = [](double, double) { return 50; };
  const std::vector<double> v = {0, 180};
  const auto down = [&](const std::string& head) {
    return Toward(Read(File(1, v, {0}, fifty, head, "0.5 3 40")), {0, 0, -1});
  };
  EXPECT_EQ(down("IESNA:LM-63-2002\n"), 25);
  EXPECT_EQ(down("IES:LM-63-2019\n"), 25);  // the second field is of another kind
  EXPECT_EQ(down("IESNA:LM-63-1995\n"), 75);
  EXPECT_EQ(down("a lamp of 1986\n"), 75);
}

// Planes at 0, 90, 180 and 270 degrees: +x, +y, -x, -y.
TEST(ReadIes, PlanesThatSymmetryLeavesOutAreFilledIn) {
  const auto by_plane = [](double, double h) { return 1 + h; };
  const auto around = [&](const std::vector<double>& h) {
    const LampProfile lamp = Read(File(1, {0, 180}, h, by_plane));
    return std::vector<double>{Toward(lamp, {1, 0, 0}), Toward(lamp, {0, 1, 0}),
                               Toward(lamp, {-1, 0, 0}), Toward(lamp, {0, -1, 0})};
  };
  const auto expect = [](const std::vector<double>& a, const std::vector<double>& b) {
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(a[k], b[k], 1e-4) << k;
  };
  expect(around({0, 45, 90}), {1, 91, 1, 91});
  expect(around({0, 90, 180}), {1, 91, 181, 91});
  expect(around({0, 90, 180, 270, 359.99999}), {1, 91, 181, 271});
  expect(around({90, 180, 270}), {181, 91, 181, 271});
}

// One lamp, written both ways: the pole of type B is +x.
TEST(ReadIes, TypeBIsTheSameLampInOtherAngles) {
  const auto lobe = [](Vec3 d) { return 100 * std::max(0.0, -d.z) * (1 + 0.5 * d.x + 0.25 * d.y); };
  const LampProfile b = Read(File(2, Steps(-90, 90, 2), Steps(-90, 90, 2), [&](double v, double h) {
    const double s = std::sin(h * kPi / 180), c = std::cos(h * kPi / 180);
    return lobe({s, c * std::sin(v * kPi / 180), -c * std::cos(v * kPi / 180)});
  }));
  const LampProfile c = Read(File(1, Steps(0, 90, 2), Steps(0, 360, 5), [&](double v, double h) {
    const double s = std::sin(v * kPi / 180);
    return lobe(
        {s * std::cos(h * kPi / 180), s * std::sin(h * kPi / 180), -std::cos(v * kPi / 180)});
  }));
  EXPECT_NEAR(b.intensity_cd->total().r / c.intensity_cd->total().r, 1, 1e-3);
  for (Vec3 d : {Vec3{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {-1, 0.5, -2}, {0.3, -0.7, -0.2}}) {
    EXPECT_NEAR(Toward(b, d), lobe(Normalized(d)), 0.2);
    EXPECT_NEAR(Toward(c, d), lobe(Normalized(d)), 0.2);
  }
  EXPECT_EQ(Toward(b, {0, 0, 1}), 0);
}

TEST(ReadIes, HalvesOfTypeBAreMirrored) {
  const LampProfile lamp =
      Read(File(2, {0, 45, 90}, {0, 45, 90}, [](double v, double h) { return 1 + v + 1000 * h; }));
  EXPECT_NEAR(Toward(lamp, {1, 0, -1}), 45001, 2);
  EXPECT_NEAR(Toward(lamp, {-1, 0, -1}), 45001, 2);
  EXPECT_NEAR(Toward(lamp, {0, 1, -1}), 46, 1e-3);
  EXPECT_NEAR(Toward(lamp, {0, -1, -1}), 46, 1e-3);
}

TEST(ReadIes, TiltThatIsIncludedIsPassedOver) {
  std::string text = File(1, {0, 180}, {0}, [](double, double) { return 50; });
  const size_t at = text.find("TILT=NONE");
  text.replace(at, 9, "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8");
  EXPECT_EQ(Toward(Read(text), {0, 0, -1}), 50);
}

TEST(ReadIes, FilesThatAreNoneSaySo) {
  const std::string good = File(1, {0, 90}, {0, 90}, [](double, double) { return 1; });
  const auto refused = [](const std::string& bytes) {
    const absl::Status status = ReadIes("lamp.ies", bytes).status();
    return ReasonOf(status) == "SCENE_INVALID" &&
           status.message().find("lamp.ies") != std::string::npos;
  };
  EXPECT_FALSE(refused(good));
  for (size_t length = 0; length + 2 < good.size(); ++length) {
    ASSERT_TRUE(refused(good.substr(0, length))) << length;
  }
  const auto one = [](double, double) { return 1.0; };
  EXPECT_TRUE(refused(File(3, {0, 90}, {0, 90}, one)));
  EXPECT_TRUE(refused(File(1, {90, 0}, {0, 90}, one)));
  EXPECT_TRUE(refused(File(1, {0, 90}, {0, 30}, one)));
  EXPECT_TRUE(refused(File(1, {0, 270}, {0, 90}, one)));
  EXPECT_TRUE(refused(File(1, {0, 90}, {0, 90}, [](double, double) { return -1; })));
  EXPECT_TRUE(refused(File(2, {-90, 90}, {-45, 45}, one)));
  EXPECT_TRUE(refused(File(1, {0, 180}, Steps(0, 360, 0.05), one)));  // 7,201 planes of 181 steps
  EXPECT_TRUE(refused("IESNA:LM-63-2002\nTILT=NONE\n1 1 1 1e9 1e9 1 2 0 0 0\n1 1 0\n"));
  EXPECT_TRUE(refused("IESNA:LM-63-2002\nTILT=NONE\n1 1 1 two 1 1 2 0 0 0\n1 1 0\n"));
}

}  // namespace
}  // namespace lambert
