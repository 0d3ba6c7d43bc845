// The still parts of a report, built into the program.
#pragma once

namespace tern::report {

extern const char* const kPageStyle;          ///< CSS: uPlot's and ours
extern const char* const kPageCharts;         ///< uPlot
extern const char* const kPageChartsLicence;  ///< MIT
extern const char* const kPageScript;         ///< page/*.js, one function

}  // namespace tern::report
