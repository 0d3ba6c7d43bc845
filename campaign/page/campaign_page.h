// A campaign as one HTML page that needs nothing but itself: how its measures are distributed, and what failed.
#pragma once

#include <string>

#include "campaign/records/flight_table.h"

namespace tern {

/// @param failures  where the folders of failed flights are, as a link from the page's own place; "": no links
std::string campaign_page(const Flights& flights, const std::string& failures);

}  // namespace tern
