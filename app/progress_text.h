// Words for people: numbers and the state of a run in one line.
#pragma once

#include <cstdint>
#include <string>

#include "radiosity/solve/solution.h"

namespace lambert::app {

std::string FormatCount(double count, const std::string& unit);  // "950 rays", "12.3 krays"
std::string FormatPercent(double fraction);  // "12 %", "2.1 %", "0.97 %", "0.0031 %"
std::string FormatDuration(
    double seconds);                     // "0.42 s", "12 s", "3 min 04 s", "2 h 07 min", "3 days"
std::string FormatBytes(int64_t bytes);  // "812 B", "3.4 MiB"

// Seconds until the wanted error is reached or the ray budget (`max_time_s`: the time budget, 0:
// none) is spent, whichever comes first; -1 while nothing can be said.
double EstimateSecondsLeft(const Progress& progress, double max_time_s);

// How much of the way is done, 0..1: of the error that falls with the square root of the rays, or
// of a budget, whichever is nearer to its end.
double EstimateFractionDone(const Progress& progress, double max_time_s);

// "pass 12  error 2.1 % -> 1.0 %  12 s left  3.42 Mrays  1.71 Mrays/s  unsent 0.3 %"
std::string DescribeProgress(const Progress& progress, double max_time_s);

// The same behind a bar; in `width` columns, without the bar or cut where they are too few.
std::string DrawProgressBar(const Progress& progress, double max_time_s, int width);

}  // namespace lambert::app
