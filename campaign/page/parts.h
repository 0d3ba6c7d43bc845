// The still parts of the page, built into the program.
#pragma once

namespace tern {

extern const char* const kCampaignStyle;   ///< CSS: that of a flight's report
extern const char* const kCampaignScript;  ///< its helpers.js, then campaign.js

}  // namespace tern
