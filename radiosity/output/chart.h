// Error against time as an inline SVG, both axes logarithmic.
#pragma once

#include <string>
#include <vector>

namespace lambert {

struct ChartSeries {
  std::string label;
  std::string css_class;  // of its line; the page says which colour that is
  std::vector<double> x, y;
};

// Points whose x or y is not positive and finite are left out; "" where fewer than two points are
// left in all series together. `level` > 0 draws a horizontal line with that label.
std::string LogLogChart(const std::vector<ChartSeries>& series, const std::string& x_title,
                        const std::string& y_title, double level, const std::string& level_label);

// Text with &, <, > and quotes replaced, for HTML and SVG.
std::string EscapeHtml(const std::string& text);

}  // namespace lambert
