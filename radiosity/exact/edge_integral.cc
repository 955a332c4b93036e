#include "radiosity/exact/edge_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lambert {
namespace {

// The rule of a piece whose distance from the other edge is at least `distance` half lengths. The
// integrand is analytic in the ellipse through the nearest singularity, whose half axes sum to
// rho = distance + sqrt(distance^2 - 1); the rule's error falls like rho^(-2 points).
struct Order {
  double distance;
  int points;
};
constexpr Order kOrders[] = {{40, 4}, {12, 5}, {4, 8}, {2, 12}};
constexpr int kMaxPoints = 12;
// Halvings of an edge that touches the other away from its ends. What is left then adds less than
// 2^-26 squared.
constexpr int kMaxHalvings = 26;
constexpr double kParallel = 1e-12;  // sine of an angle that is none: what it adds is as small

struct Rule {
  std::array<double, kMaxPoints> node{}, weight{};  // on -1 .. 1
};

// Nodes by Newton's method on the Legendre polynomial.
Rule MakeRule(int points) {
  Rule rule;
  for (int k = 0; k < points; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (points + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double before = 1, value = x;
      for (int n = 2; n <= points; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      slope = points * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.node[k] = x;
    rule.weight[k] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

const Rule& RuleOf(int points) {
  static const std::array<Rule, kMaxPoints + 1> rules = [] {
    std::array<Rule, kMaxPoints + 1> made;
    for (const Order& order : kOrders) made[order.points] = MakeRule(order.points);
    return made;
  }();
  return rules[points];
}

double XLogX2(double x, double square) { return x == 0 ? 0 : 0.5 * x * std::log(square); }

// How far from p(s), over complex s, ln r integrated along q is analytic at least. It is singular
// where p meets an end of q, and where p's line meets q's between the ends: distance from q's line
// over the sine of the angle. Both bounds hold: the larger one counts.
double AnalyticRadius(Vec3 x, const Edge& p, const Edge& q) {
  const Vec3 away = x - q.from;
  const double along = Dot(away, q.direction);
  const double ends = std::min(Length(away), Length(x - q.to));
  if (along <= 0 || along >= q.length) return ends;
  const double height = Length(Cross(away, q.direction));
  const double sine = Length(Cross(p.direction, q.direction));
  return sine < kParallel ? ends : std::min(ends, height / sine);
}

// The edges share the end that is not p_far and not q_far. ln r + c scales like a homogeneous
// function: with r^2 quadratic in (s, t), s df/ds + t df/dt = 1, so the divergence of (s, t) f is 2
// f + 1 and
//   integral f = 1/2 (sum over the far sides of length * integral of f there - a b).
double FromSharedEnd(const Edge& p, const Edge& q, Vec3 p_far, Vec3 q_far) {
  return 0.5 * (p.length * LogDistanceIntegral(p_far, q) +
                q.length * LogDistanceIntegral(q_far, p) - p.length * q.length);
}

int PointsFor(double distance) {
  for (const Order& order : kOrders) {
    if (distance >= order.distance) return order.points;
  }
  return 0;
}

double Piece(const Edge& p, const Edge& q, double begin, double end, int halvings) {
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  const double distance = AnalyticRadius(p.At(middle), p, q) / half;
  int points = PointsFor(distance);
  if (points == 0) {
    if (halvings < kMaxHalvings) {
      return Piece(p, q, begin, middle, halvings + 1) + Piece(p, q, middle, end, halvings + 1);
    }
    points = kMaxPoints;
  }
  const Rule& rule = RuleOf(points);
  double sum = 0;
  for (int k = 0; k < points; ++k) {
    sum += rule.weight[k] * LogDistanceIntegral(p.At(middle + half * rule.node[k]), q);
  }
  return sum * half;
}

}  // namespace

Edge EdgeBetween(Vec3 from, Vec3 to) {
  const Vec3 along = to - from;
  const double length = std::sqrt(Dot(along, along));
  return {from, to, along / length, length};
}

double LogDistanceIntegral(Vec3 x, const Edge& edge) {
  const Vec3 away = x - edge.from;
  const Vec3 across = Cross(away, edge.direction);
  const double height2 = Dot(across, across), height = std::sqrt(height2);
  const double begin = -Dot(away, edge.direction), end = begin + edge.length;
  // With u along the edge from the foot of x:  integral ln r du = u ln r - u + h atan(u / h)
  return XLogX2(end, end * end + height2) - XLogX2(begin, begin * begin + height2) - edge.length +
         height * std::atan2(height * edge.length, height2 + begin * end);
}

double LogDistanceIntegral(const Edge& p, const Edge& q) {
  if (p.from == q.from) return FromSharedEnd(p, q, p.to, q.to);
  if (p.from == q.to) return FromSharedEnd(p, q, p.to, q.from);
  if (p.to == q.from) return FromSharedEnd(p, q, p.from, q.to);
  if (p.to == q.to) return FromSharedEnd(p, q, p.from, q.from);
  return Piece(p, q, 0, p.length, 0);
}

}  // namespace lambert
