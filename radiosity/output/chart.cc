#include "radiosity/output/chart.h"

#include <algorithm>
#include <cmath>

#include "radiosity/output/number_text.h"

namespace lambert {
namespace {

// The drawing, in SVG user units, and the margins around its axes.
constexpr double kWidth = 720, kHeight = 340;
constexpr double kLeft = 64, kRight = 20, kTop = 16, kBottom = 48;

// A logarithmic axis whose ends are round numbers.
struct LogAxis {
  double low = 1, high = 10;       // values
  double at_low = 0, at_high = 1;  // places

  double Place(double value) const {
    return at_low + (at_high - at_low) * std::log(value / low) / std::log(high / low);
  }

  // 1, 2, 5 times powers of ten; only some powers of ten where those are many.
  std::vector<double> Ticks() const {
    const double decades = std::log10(high / low);
    const bool dense = decades < 3.2;
    const double stride = std::max(1.0, std::ceil(decades / 8));
    std::vector<double> ticks;
    for (double power = std::floor(std::log10(low)); power <= std::log10(high); power += stride) {
      for (double step : {1.0, 2.0, 5.0}) {
        const double tick = step * std::pow(10.0, power);
        if (step > 1 && !dense) continue;
        if (tick > low * 0.999 && tick < high * 1.001) ticks.push_back(tick);
      }
    }
    return ticks;
  }
};

double RoundDown(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : {5.0, 2.0}) {
    if (value >= step * decade) return step * decade;
  }
  return decade;
}

double RoundUp(double value) {
  const double down = RoundDown(value);
  if (down >= value) return down;
  const double decade = std::pow(10.0, std::floor(std::log10(down) + 1e-9));
  for (double step : {2.0, 5.0}) {
    if (value <= step * decade) return step * decade;
  }
  return 10 * decade;
}

LogAxis MakeAxis(const std::vector<double>& values, double at_low, double at_high) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  LogAxis axis{RoundDown(*least), RoundUp(*most), at_low, at_high};
  if (axis.high <= axis.low) axis.high = 10 * axis.low;
  return axis;
}

std::string Number(double place) { return RoundedText(std::round(place * 10) / 10, 6); }

std::string Line(double x1, double y1, double x2, double y2, const std::string& css_class) {
  return "<line class=\"" + css_class + "\" x1=\"" + Number(x1) + "\" y1=\"" + Number(y1) +
         "\" x2=\"" + Number(x2) + "\" y2=\"" + Number(y2) + "\"/>";
}

std::string Text(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + Number(x) + "\" y=\"" + Number(y) + "\" text-anchor=\"" + anchor + "\">" +
         EscapeHtml(text) + "</text>";
}

std::string Percent(double ratio) { return RoundedText(100 * ratio, 3) + " %"; }

std::string Axes(const LogAxis& x, const LogAxis& y, const std::string& x_title,
                 const std::string& y_title) {
  std::string svg;
  for (double tick : x.Ticks()) {
    svg += Line(x.Place(tick), y.at_low, x.Place(tick), y.at_high, "grid");
    svg += Text(x.Place(tick), y.at_low + 18, "middle", RoundedText(tick, 3));
  }
  for (double tick : y.Ticks()) {
    svg += Line(x.at_low, y.Place(tick), x.at_high, y.Place(tick), "grid");
    svg += Text(x.at_low - 8, y.Place(tick) + 4, "end", Percent(tick));
  }
  svg += Text((x.at_low + x.at_high) / 2, kHeight - 8, "middle", x_title);
  svg += "<text transform=\"translate(14 " + Number((y.at_low + y.at_high) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">" + EscapeHtml(y_title) + "</text>";
  return svg;
}

// The points of a series that a logarithmic chart can show.
ChartSeries Drawable(const ChartSeries& series) {
  ChartSeries kept{series.label, series.css_class, {}, {}};
  for (size_t k = 0; k < series.x.size(); ++k) {
    const bool drawable = series.x[k] > 0 && series.y[k] > 0 && std::isfinite(series.x[k]) &&
                          std::isfinite(series.y[k]);
    if (!drawable) continue;
    kept.x.push_back(series.x[k]);
    kept.y.push_back(series.y[k]);
  }
  return kept;
}

std::string Curve(const ChartSeries& series, const LogAxis& x, const LogAxis& y) {
  std::string points, dots;
  for (size_t k = 0; k < series.x.size(); ++k) {
    const std::string px = Number(x.Place(series.x[k])), py = Number(y.Place(series.y[k]));
    points += px + "," + py + " ";
    dots += "<circle class=\"" + series.css_class + "\" cx=\"" + px + "\" cy=\"" + py +
            "\" r=\"2.6\"/>";
  }
  return "<polyline class=\"" + series.css_class + "\" points=\"" + points + "\"/>" + dots;
}

}  // namespace

std::string EscapeHtml(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped.push_back(c);
    }
  }
  return escaped;
}

std::string LogLogChart(const std::vector<ChartSeries>& series, const std::string& x_title,
                        const std::string& y_title, double level, const std::string& level_label) {
  std::vector<ChartSeries> drawable;
  std::vector<double> all_x, all_y;
  for (const ChartSeries& one : series) {
    drawable.push_back(Drawable(one));
    all_x.insert(all_x.end(), drawable.back().x.begin(), drawable.back().x.end());
    all_y.insert(all_y.end(), drawable.back().y.begin(), drawable.back().y.end());
  }
  if (all_x.size() < 2) return "";
  if (level > 0) all_y.push_back(level);
  const LogAxis x = MakeAxis(all_x, kLeft, kWidth - kRight);
  const LogAxis y = MakeAxis(all_y, kHeight - kBottom, kTop);
  std::string svg = "<svg class=\"chart\" viewBox=\"0 0 " + Number(kWidth) + " " + Number(kHeight) +
                    "\" role=\"img\" aria-label=\"" + EscapeHtml(y_title) + " against " +
                    EscapeHtml(x_title) + "\">";
  svg += Axes(x, y, x_title, y_title);
  if (level > 0) {
    svg += Line(x.at_low, y.Place(level), x.at_high, y.Place(level), "level");
    svg += Text(x.at_high - 4, y.Place(level) - 5, "end", level_label);
  }
  double legend_y = kTop + 16;
  for (const ChartSeries& one : drawable) {
    if (one.x.empty()) continue;
    svg += Curve(one, x, y);
    const double legend_x = kWidth - kRight - 190;
    svg += Line(legend_x, legend_y - 4, legend_x + 22, legend_y - 4, one.css_class);
    svg += Text(legend_x + 28, legend_y, "start", one.label);
    legend_y += 18;
  }
  return svg + "</svg>";
}

}  // namespace lambert
