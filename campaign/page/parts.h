// The constant parts of the page, built into the program.
#pragma once

namespace tern {

extern const char* const kCampaignStyle;   ///< CSS: that of a flight's report
extern const char* const kCampaignScript;  ///< the report's helpers.js, then campaign.js

}  // namespace tern
