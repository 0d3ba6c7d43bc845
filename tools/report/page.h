// The constant parts of the report's page, built into the program.
#pragma once

namespace tern::report {

extern const char* const kPageStyle;          ///< CSS: uPlot's and ours
extern const char* const kPageCharts;         ///< uPlot
extern const char* const kPageChartsLicence;  ///< MIT
extern const char* const kPageScript;         ///< page/*.js as one function

}  // namespace tern::report
