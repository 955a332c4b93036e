// The program gnuplot, and the parts of scripts for it that all figures share.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"

namespace lambert::app {

// `text` as a string of gnuplot's own that is taken as it is: 'it''s'.
std::string GnuplotQuoted(const std::string& text);

// The first lines of a script that makes NAME.png, or with `gnuplot -e "format='svg'"` NAME.svg.
std::string GnuplotTerminal(const std::string& name, int width, int height);

// Line types 1 to 24 that people with any colour vision tell apart: colours of Okabe and Ito
// (2008), then the same with dashes; each with a point of its own.
std::string GnuplotLineTypes();

// How wide a line of text is at most, with margins, in pixels.
int GnuplotTextWidth(const std::string& text);

// Starts a multiplot under two lines: a title and what there is to know about it. `left` in pixels
// of the figure, as `width` and `height`.
std::string GnuplotHeadline(const std::string& title, const std::string& facts, int left, int width,
                            int height);

// Where the next plot of a multiplot stands, in pixels from the upper left corner of a figure of
// `width` and `height`.
std::string GnuplotPlace(int left, int top, int plot_width, int plot_height, int width, int height);

// Runs FOLDER/SCRIPT in FOLDER, once for each of `formats` ("png", "svg"). GNUPLOT_FAILED with what
// gnuplot said, or where it is not installed.
absl::Status RunGnuplot(const std::string& folder, const std::string& script,
                        const std::vector<std::string>& formats);

}  // namespace lambert::app
