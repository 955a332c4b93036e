// Numbers as text that reads back to the same bits, whatever the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace lambert {

// Appends the shortest decimal that reads back to `value`.
template <typename Number>
void AppendNumber(Number value, std::string& text) {
  char buffer[40];
  const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof(buffer), value);
  text.append(buffer, end.ptr);
}

// `value` rounded to `digits` significant digits: "0.0312", "1.2e+06".
inline std::string RoundedText(double value, int digits) {
  char buffer[40];
  const std::to_chars_result end =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, digits);
  return std::string(buffer, end.ptr);
}

}  // namespace lambert
